#pragma once

#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::scene {

/// Which of a light's maps a receiver reads. raster_gl/shaders/map_choice.glsl and cube_faces.glsl
/// are the same rules in GLSL, equal to the bit.
enum class MapChoice : std::uint8_t {
    containing, ///< the first that contains it; the last where none does
    cube_face,  ///< the face of `cube_faces` that fl(P − L) meets (`cube_face_towards`)
};

/// The clip position of a point, in float32, each product and each sum rounded, in the order
/// ((X·x + Y·y) + Z·z) + T of the matrix's columns.
[[nodiscard]] Vec4f clip_position(const Mat4f& clip_from_world, const Vec3f& point);

/// Whether a map contains the receiver at this clip position: before the light, on a texel, and
/// between near and far.
///
///     w > 0,   0 <= fl(x + w) < 2w,   y alike,   −w <= z <= w   (clip range [0, 1]: 0 <= z <= w)
///
/// Where w = 1, fl(x + w)/2 is the lookup's own coordinate on the map.
[[nodiscard]] bool contains(const LightFrustum& map, const Vec4f& clip);

/// Index of the map that a receiver reads.
/// @param maps   of a light, in their order; at least one.
/// @param point  where the receiver is [m].
[[nodiscard]] std::size_t chosen_map(std::span<const LightFrustum> maps, MapChoice choice,
                                     const Vec3f& point);

} // namespace gnomon::scene
