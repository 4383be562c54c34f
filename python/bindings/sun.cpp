#include "scene/light/sun.hpp"

#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace gnomon::python {
namespace {

using Milliseconds = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Seconds since 1970 in UTC.
std::int64_t utc_milliseconds(const std::string& text)
{
    const auto time = scene::utc_time(text);
    if (!time) {
        throw scene::InputError(fmt::format("time = \"{}\": must be such as "
                                            "\"2026-06-21T12:00:00Z\", or end with +02:00",
                                            text));
    }
    return time->time_since_epoch().count();
}

/// n × 2: azimuth and elevation [deg].
py::array_t<double> sun_positions(double latitude_deg, double longitude_deg,
                                  const Milliseconds& times)
{
    if (!(latitude_deg >= -90 && latitude_deg <= 90)) {
        throw scene::InputError(fmt::format("latitude_deg = {}: must be -90 to 90", latitude_deg));
    }
    if (!(longitude_deg >= -180 && longitude_deg <= 180)) {
        throw scene::InputError(
            fmt::format("longitude_deg = {}: must be -180 to 180", longitude_deg));
    }
    py::array_t<double> found{{times.size(), py::ssize_t{2}}};
    for (py::ssize_t i = 0; i < times.size(); ++i) {
        const scene::UtcTime time{std::chrono::milliseconds{times.at(i)}};
        if (!scene::has_sun(time)) {
            throw scene::InputError(fmt::format("time[{}]: must be in the years {} to {}", i,
                                                scene::first_sun_year, scene::last_sun_year));
        }
        const scene::SunPosition sun = scene::sun_position(latitude_deg, longitude_deg, time);
        found.mutable_at(i, 0) = sun.azimuth_deg;
        found.mutable_at(i, 1) = sun.elevation_deg;
    }
    return found;
}

/// n × 3: the direction in which the light travels.
py::array_t<double> sun_directions(const py::array_t<double>& positions, double north_x,
                                   double north_z)
{
    py::array_t<double> found{{positions.shape(0), py::ssize_t{3}}};
    for (py::ssize_t i = 0; i < positions.shape(0); ++i) {
        const scene::Vec3d way =
            scene::sun_direction({positions.at(i, 0), positions.at(i, 1)}, {north_x, 0, north_z});
        for (int axis = 0; axis < 3; ++axis) {
            found.mutable_at(i, axis) = way[axis];
        }
    }
    return found;
}

} // namespace

void bind_sun(py::module_& module)
{
    module.def("utc_milliseconds", &utc_milliseconds);
    module.def("sun_positions", &sun_positions);
    module.def("sun_directions", &sun_directions);
}

} // namespace gnomon::python
