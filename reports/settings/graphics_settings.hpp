#pragma once

#include "analysis/presets/engine_settings.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// A language or graphics API that a job's map is written for.
enum class GraphicsTarget : std::uint8_t {
    glsl, ///< the lookup in OpenGL's and Vulkan's shaders
    hlsl, ///< the lookup in Direct3D's shaders
    gl,   ///< states that draw the map
    direct3d,
    vulkan,
};

/// Their names for `--engine`, in the order of the enumerators.
[[nodiscard]] std::span<const std::string_view> graphics_target_names();
/// The target of this name, in upper or lower case; empty if the name is unknown.
[[nodiscard]] std::optional<GraphicsTarget> graphics_target_from_name(std::string_view name);
/// "OpenGL".
[[nodiscard]] std::string_view graphics_target_title(GraphicsTarget target);

/// A job's shadow map as code.
struct GraphicsSettings : analysis::ChosenBias {
    GraphicsTarget target = GraphicsTarget::glsl;
    std::vector<std::string> lines;
    std::vector<std::string> cannot; ///< keys of the job that no line applies
};

/// Writes a comparison's shadow map for a language or API.
/// @throws scene::InputError  if the job's method is not `depth` or `pcf`, and as `lookup_shader`.
[[nodiscard]] GraphicsSettings graphics_settings(GraphicsTarget target,
                                                 const analysis::Comparison& comparison,
                                                 const analysis::BiasChoice& choice);

} // namespace gnomon::reports
