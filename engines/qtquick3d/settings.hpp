#pragma once

#include "cpp/json.hpp"
#include "cpp/scene.hpp"

namespace engine::qt_adapter {

/// The keys of [engine].
[[nodiscard]] Json keys();

/// Units of Qt Quick 3D in a metre.
/// @param engine  The draw's [engine].
[[nodiscard]] double units_per_metre(const Json& engine);

/// The material's cullMode.
[[nodiscard]] int cull_mode(const Json& engine);

/// The light's shadowMapQuality of maps of so many texels a side: 256, 512, 1024 or 2048.
[[nodiscard]] int quality_of(int resolution);

/// Refuses what a draw says and Qt Quick 3D does not do.
/// @throws Refusal  by key.
void check(const Json& draw, LightType light);

/// `case` of the answer: what was done.
[[nodiscard]] Json tables(const Json& draw, const Scene& scene);

} // namespace engine::qt_adapter
