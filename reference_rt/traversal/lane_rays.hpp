#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/traversal/lanes.hpp"
#include "reference_rt/traversal/packet.hpp"

/// Rays and points of a packet, component by component.
namespace gnomon::reference_rt {

/// The rays of a packet: E, d.
struct LaneRays {
    Lanes3 origin, direction;
    LaneBits is_well_scaled = 0; ///< may the filter be asked (arithmetic.hpp)

    [[nodiscard]] CameraRay ray(std::size_t lane) const
    {
        return CameraRay{{{origin.x[lane], origin.y[lane], origin.z[lane]},
                          {direction.x[lane], direction.y[lane], direction.z[lane]}}};
    }
};

/// Where the rays of a packet meet the planes of their receivers, as `Receiver` says it.
struct LaneHits {
    Lanes<double> t, t_error;
    LaneBits delta_is_positive = 0; ///< exact
    LaneBits delta_is_negative = 0; ///< "
};

/// The lanes that are attached (predicates.hpp), the light being on that side of their planes.
[[nodiscard]] inline LaneBits are_attached(const LaneHits& hits, Sign light_side)
{
    switch (light_side) {
    case 1:
        return ~hits.delta_is_negative;
    case -1:
        return ~hits.delta_is_positive;
    default:
        return hits.delta_is_positive | hits.delta_is_negative;
    }
}

/// A point in the unit frame, and what each component may be off.
struct IntervalPoint {
    scene::Vec3d position{};
    double error = 0;
};

/// The same for each lane of a packet.
struct LanePositions {
    Lanes3 position;
    Lanes<double> error;

    void set(std::size_t lane, const IntervalPoint& point)
    {
        position.x[lane] = point.position.x;
        position.y[lane] = point.position.y;
        position.z[lane] = point.position.z;
        error[lane] = point.error;
    }
    [[nodiscard]] scene::Vec3d at(std::size_t lane) const
    {
        return {position.x[lane], position.y[lane], position.z[lane]};
    }
};

/// The rays of a packet in Embree's precision, from 0 to t_far in units of their directions.
struct FloatRays {
    Lanes<float> origin_x, origin_y, origin_z;
    Lanes<float> direction_x, direction_y, direction_z;
    Lanes<float> t_far;

    void set(std::size_t lane, const FloatRay& ray)
    {
        origin_x[lane] = ray.origin.x;
        origin_y[lane] = ray.origin.y;
        origin_z[lane] = ray.origin.z;
        direction_x[lane] = ray.direction.x;
        direction_y[lane] = ray.direction.y;
        direction_z[lane] = ray.direction.z;
        t_far[lane] = ray.t_far;
    }
};

} // namespace gnomon::reference_rt
