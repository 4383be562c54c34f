#pragma once

#include "scene/settings/filter.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>
#include <string>

/// Parts of lines of shader code that several translations share.
namespace gnomon::reports {

/// A language for shaders.
enum class ShaderLanguage : std::uint8_t { glsl, hlsl };

/// A number as a shader writes it: "0.0" for 0, with the digits that give the same number back.
[[nodiscard]] std::string shader_number(double value);
[[nodiscard]] std::string shader_number(float value);

/// slope · tan θ, for the unit vectors N, the triangle's normal, and L, towards the light.
[[nodiscard]] std::string slope_term(double slope);

/// Compares a depth with the map: in the sampler, or in the shader if it reads the map's depths.
/// @param depth  an expression.
/// @return  A statement that assigns to `lit`.
[[nodiscard]] std::string comparison(const scene::ShadowMapSettings& map, scene::Filter filter,
                                     const std::string& depth, ShaderLanguage language);

} // namespace gnomon::reports
