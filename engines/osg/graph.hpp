#pragma once

#include "cpp/scene.hpp"

#include <osg/Group>
#include <osg/Light>
#include <osg/ref_ptr>

namespace engine::osg_adapter {

/// Bits of a node's mask: drawn in the frame, and drawn into the map.
inline constexpr unsigned is_drawn = 1;
inline constexpr unsigned casts_shadow = 2;

/// A texture unit that no technique uses. Its coordinates pass the world position through the fixed
/// functions to the fragment shader.
inline constexpr unsigned position_unit = 3;

/// The objects with a normal for each triangle. Those that are not seen are hidden from `eye`.
[[nodiscard]] osg::ref_ptr<osg::Group> make_objects(const Scene& scene, const osg::Camera& eye);

[[nodiscard]] osg::ref_ptr<osg::Light> make_light(const Light& light);

[[nodiscard]] osg::Vec3d osg_vector(const Vector3& v);
[[nodiscard]] Vector3 vector_of(const osg::Vec3d& v);

} // namespace engine::osg_adapter
