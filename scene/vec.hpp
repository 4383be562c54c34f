#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gnomon::scene {

using Vec2f = glm::vec2;
using Vec3f = glm::vec3;
using Vec4f = glm::vec4;
using Vec2d = glm::dvec2;
using Vec3d = glm::dvec3;
using Vec4d = glm::dvec4;
/// Column-major as in GL: `m[column][row]`. Named destination-from-source.
using Mat4f = glm::mat4;
using Mat4d = glm::dmat4;

/// The nearest float32 of each component, as doubles.
///
/// Do not write `Vec3d{Vec3f{v}}` instead: GCC 12 at -O2 vectorises the conversions of x and y and
/// then drops them, so that nothing is rounded.
[[nodiscard]] Vec3d rounded_to_float32(const Vec3d& v);

} // namespace gnomon::scene
