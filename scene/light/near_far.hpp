#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"

#include <span>

namespace gnomon::scene {

/// Least range of ζ and map side for flat scenes, relative to the scene's diagonal.
inline constexpr double smallest_relative_extent = 1e-4;

/// A range of ζ [m].
struct LightDistanceRange {
    double nearest_m = 0;
    double farthest_m = 0;
};

/// The whole scene's range of ζ, and how auto planes follow from it.
struct WholeScene {
    LightDistanceRange range;    ///< up to the farthest visible point, if `keeps_far`
    bool keeps_far = false;      ///< `camera`: ignores geometry beyond the visible range
    double smallest_range_m = 0; ///< for flat scenes
};

/// Moves the ends of a range apart until it is at least that long.
void widen(double& lower, double& upper, double smallest);

/// If maps store distances and far is auto, moves far beyond the distance of everything within the
/// sides. Far is then a float32, because GL divides by it.
void make_room_for_distances(std::span<LightFrustum> maps, const FrustumSettings& settings,
                             const TriangleScene& scene);

/// Sets near and far, shared by all of a light's maps: from the settings, or around the triangles
/// within the sides of any map, or around the whole scene. Precondition: axes, origin and sides are
/// set, and all maps have one projection.
/// @throws InputError  if near >= far, if they are too close for float32 depths, or if a
///                     perspective's near is not above 0.
void set_near_far(std::span<LightFrustum> maps, const FrustumSettings& settings,
                  const TriangleScene& scene, const WholeScene& whole);

/// Sets near and far of one map: from the settings, or around a range with padding, whatever the
/// sides contain.
/// @throws InputError  as above.
void set_near_far_around(LightFrustum& map, const FrustumSettings& settings,
                         const LightDistanceRange& range);

} // namespace gnomon::scene
