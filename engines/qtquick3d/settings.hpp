#pragma once

#include "cpp/json.hpp"
#include "cpp/scene.hpp"

namespace engine::qt_adapter {

/// The keys of [engine].
[[nodiscard]] Json keys();

/// Units of Qt Quick 3D in a metre.
/// @param engine  the draw's [engine].
[[nodiscard]] double units_per_metre(const Json& engine);

/// The material's cullMode.
[[nodiscard]] int cull_mode(const Json& engine);

/// The light's shadowMapQuality for maps of 256, 512, 1024 or 2048 texels a side.
[[nodiscard]] int quality_of(int resolution);

/// Refuses keys that Qt Quick 3D does not support.
/// @throws Refusal  by key.
void check(const Json& draw, LightType light);

/// `case` of the answer: the settings used.
[[nodiscard]] Json tables(const Json& draw, const Scene& scene);

} // namespace engine::qt_adapter
