#pragma once

#include "cpp/scene.hpp"

#include <osg/Group>
#include <osg/Light>
#include <osg/ref_ptr>

namespace engine::osg_adapter {

/// Bits of a node's mask: who is drawn, and who is drawn into the map.
inline constexpr unsigned is_drawn = 1;
inline constexpr unsigned casts_shadow = 2;

/// The texture unit whose coordinates are the world's positions, which fixed functions hand to the
/// fragment as they are: one that no technique uses.
inline constexpr unsigned position_unit = 3;

/// The objects, each a geometry with a normal for each triangle; those that are not seen are for
/// other cameras than `eye` alone.
[[nodiscard]] osg::ref_ptr<osg::Group> make_objects(const Scene& scene, const osg::Camera& eye);

[[nodiscard]] osg::ref_ptr<osg::Light> make_light(const Light& light);

[[nodiscard]] osg::Vec3d osg_vector(const Vector3& v);
[[nodiscard]] Vector3 vector_of(const osg::Vec3d& v);

} // namespace engine::osg_adapter
