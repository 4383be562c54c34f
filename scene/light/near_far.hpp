#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"

#include <span>

namespace gnomon::scene {

/// Share of the scene's diagonal that a range of ζ or a map's side is at least, for flat scenes.
inline constexpr double smallest_relative_extent = 1e-4;

/// A range of ζ [m].
struct LightDistanceRange {
    double nearest_m = 0;
    double farthest_m = 0;
};

/// The whole scene's range of ζ, and how auto planes follow from it.
struct WholeScene {
    LightDistanceRange range;    ///< up to the farthest that the camera sees, if `keeps_far`
    bool keeps_far = false;      ///< `camera`: nothing beyond what the camera sees matters
    double smallest_range_m = 0; ///< for flat scenes
};

/// Moves the ends of a range apart until it is at least that long.
void widen(double& lower, double& upper, double smallest);

/// Moves far behind all that lies within the sides, by distance to the light, where maps hold
/// distances and the settings leave far to us. Far is a float32 there: GL divides by it.
void make_room_for_distances(std::span<LightFrustum> maps, const FrustumSettings& settings,
                             const TriangleScene& scene);

/// Sets near and far of a light's maps, the same for all: those of the settings, else around the
/// triangles within the sides of any, else around the whole scene. Axes, origin and sides are set
/// before, of one projection.
/// @throws InputError  if near >= far, if they are too close for float32 depths, or if a
///                     perspective's near is not above 0.
void set_near_far(std::span<LightFrustum> maps, const FrustumSettings& settings,
                  const TriangleScene& scene, const WholeScene& whole);

/// Sets near and far of one map: those of the settings, else around a range, with the padding,
/// whatever the sides hold.
/// @throws InputError  as above.
void set_near_far_around(LightFrustum& map, const FrustumSettings& settings,
                         const LightDistanceRange& range);

} // namespace gnomon::scene
