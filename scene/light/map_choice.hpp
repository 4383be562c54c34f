#pragma once

#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::scene {

/// How a receiver chooses one of a light's maps. raster_gl/shaders/map_choice.glsl, cube_faces.glsl
/// and view_slices.glsl implement these rules bit for bit.
enum class MapChoice : std::uint8_t {
    containing, ///< the first map that contains it, or else the last
    cube_face,  ///< the face of `cube_faces` that fl(P − L) meets (`cube_face_towards`)
    view_depth, ///< the map of its slice of the camera's view (`ViewSlices`)
};

/// The slices of a camera's view, along its axis, in float32.
struct ViewSlices {
    Vec3f eye;               ///< [m]
    Vec3f forward;           ///< unit, up to rounding
    std::vector<float> ends; ///< view depth of each slice's end, ascending [m]; of cascades, one
                             ///< for each map

    float begin = 0; ///< view depth at which the first slice begins [m]
    /// View depth at which blending each slice with the next begins [m]; for the last slice, its
    /// end. Empty: no blending.
    std::vector<float> mixed_from = {};

    /// View depth of a point, with each difference, product and sum rounded:
    ///
    ///     (f.x·(P.x − e.x) + f.y·(P.y − e.y)) + f.z·(P.z − e.z)
    [[nodiscard]] float view_depth_m(const Vec3f& point) const;
    /// The first slice that ends beyond the point, or else the last.
    [[nodiscard]] std::size_t slice_of(const Vec3f& point) const;
};

/// The clip position of a point, in float32, each product and each sum rounded, in the order
/// ((X·x + Y·y) + Z·z) + T of the matrix's columns.
[[nodiscard]] Vec4f clip_position(const Mat4f& clip_from_world, const Vec3f& point);

/// Whether a map contains the receiver at this clip position: in front of the light, on a texel,
/// and between near and far.
///
///     w > 0,   0 <= fl(x + w) < 2w,   y alike,   −w <= z <= w   (clip range [0, 1]: 0 <= z <= w)
///
/// If w = 1, fl(x + w)/2 is the lookup's coordinate on the map.
[[nodiscard]] bool contains(const LightFrustum& map, const Vec4f& clip);

/// Index of the map that a receiver reads.
/// @param maps    of a light, in order; at least one.
/// @param slices  used by `view_depth`.
/// @param point   the receiver's position [m].
[[nodiscard]] std::size_t chosen_map(std::span<const LightFrustum> maps, MapChoice choice,
                                     const ViewSlices& slices, const Vec3f& point);

} // namespace gnomon::scene
