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

} // namespace gnomon::scene
