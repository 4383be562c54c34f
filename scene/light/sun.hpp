#pragma once

#include "scene/light/light.hpp"
#include "scene/vec.hpp"

#include <chrono>
#include <optional>
#include <string_view>

namespace gnomon::scene {

using UtcTime = std::chrono::sys_time<std::chrono::milliseconds>;

/// Parses "2026-06-21T12:00:00Z". Seconds may be missing or have a fraction; an offset, "+02:00",
/// may replace Z. Empty if the text is not such a time.
[[nodiscard]] std::optional<UtcTime> utc_time(std::string_view text);

/// The default north; x then points east.
inline constexpr Vec3d usual_north{0, 0, -1};

/// The direction of the sun's centre, without atmospheric refraction.
struct SunPosition {
    /// Clockwise from north, [0, 360). At the south pole, north is along the longitude's meridian;
    /// at the north pole, along the opposite one.
    double azimuth_deg = 0;
    double elevation_deg = 0; ///< above the horizon, [−90, 90]
};

/// The years that the algorithm covers.
inline constexpr int first_sun_year = 2010;
inline constexpr int last_sun_year = 2109;

/// Whether the time is within those years.
[[nodiscard]] bool has_sun(UtcTime time);

/// Where the sun stands. Errs by at most 0.0027°, plus up to 0.004° because UTC stands in for UT1,
/// which differs by less than a second. Precondition: `has_sun(time)`.
/// @param longitude_deg  east of Greenwich.
/// Source: R. Grena, "Five new algorithms for the computation of sun position from 2010 to 2110",
/// Solar Energy 86, 2012, algorithm 5.
[[nodiscard]] SunPosition sun_position(double latitude_deg, double longitude_deg, UtcTime time);

/// The direction in which sunlight travels, of length 1, in a scene with y up.
/// @param north  only its horizontal part counts, which must not be zero.
[[nodiscard]] Vec3d sun_direction(const SunPosition& sun, const Vec3d& north);

/// The light with a direction computed from its sun. Precondition: the sun's time is covered.
[[nodiscard]] LightSettings with_direction(LightSettings light, const Vec3d& north);

} // namespace gnomon::scene
