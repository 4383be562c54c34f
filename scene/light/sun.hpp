#pragma once

#include "scene/light/light.hpp"
#include "scene/light/utc_time.hpp"
#include "scene/vec.hpp"

namespace gnomon::scene {

/// The way that is north where nothing else is said; then x points east.
inline constexpr Vec3d usual_north{0, 0, -1};

/// Where the centre of the sun's disc stands, without the air's refraction.
struct SunPosition {
    /// Clockwise from north, [0, 360). At the south pole north is the way along the longitude's
    /// meridian, at the north pole along the opposite one.
    double azimuth_deg = 0;
    double elevation_deg = 0; ///< above the horizon, [−90, 90]
};

/// Years whose sun is known.
inline constexpr int first_sun_year = 2010;
inline constexpr int last_sun_year = 2109;

/// Whether the time is within those years.
[[nodiscard]] bool has_sun(UtcTime time);

/// @param longitude_deg  east of Greenwich.
/// Precondition: `has_sun(time)`. Errs by at most 0.0027°, and by up to 0.004° more because UTC is
/// taken for UT1, from which it is less than a second away. Source: R. Grena, "Five new algorithms
/// for the computation of sun position from 2010 to 2110", Solar Energy 86, 2012, algorithm 5.
[[nodiscard]] SunPosition sun_position(double latitude_deg, double longitude_deg, UtcTime time);

/// The way that the sun's light travels, of length 1, in a scene whose y points up.
/// @param north  its horizontal part counts; it must have one.
[[nodiscard]] Vec3d sun_direction(const SunPosition& sun, const Vec3d& north);

/// The light with its direction in place of its sun, whose time is one that has a sun.
[[nodiscard]] LightSettings with_direction(LightSettings light, const Vec3d& north);

} // namespace gnomon::scene
