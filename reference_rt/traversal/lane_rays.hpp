#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "scene/widest_vectors.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>

/// Rays and points of a packet, component by component.
namespace gnomon::reference_rt {

template <typename Number>
struct alignas(64) Lanes : PacketOf<Number> {
};

struct Lanes3 {
    Lanes<double> x, y, z;
};

/// Index of the lowest lane in the set. Precondition: the set is not empty.
[[nodiscard]] inline std::size_t first_lane(LaneBits lanes)
{
    return static_cast<std::size_t>(std::countr_zero(lanes));
}

/// The lanes that hold `value`.
[[nodiscard]] inline LaneBits lanes_with(const Lanes<std::uint32_t>& numbers, std::uint32_t value)
{
    LaneBits lanes = 0;
    for (std::size_t i = 0; i < packet_size; ++i) {
        lanes |= numbers[i] == value ? LaneBits{1} << i : 0;
    }
    return lanes;
}

/// The lanes with a nonzero flag.
[[gnu::always_inline]] inline LaneBits bits_of(const Lanes<int>& flags)
{
    LaneBits bits = 0;
    for (std::size_t i = 0; i < packet_size; ++i) {
        bits |= flags[i] != 0 ? LaneBits{1} << i : 0;
    }
    return bits;
}

/// The rays of a packet: E, d.
struct LaneRays {
    Lanes3 origin, direction;
    LaneBits is_well_scaled = 0; ///< whether the filter applies (arithmetic.hpp)

    [[nodiscard]] CameraRay ray(std::size_t lane) const
    {
        return CameraRay{{{origin.x[lane], origin.y[lane], origin.z[lane]},
                          {direction.x[lane], direction.y[lane], direction.z[lane]}}};
    }
};

/// Where a packet's rays meet their receivers' planes, as in `Receiver`.
struct LaneHits {
    Lanes<double> t, t_error;
    LaneBits delta_is_positive = 0; ///< exact
    LaneBits delta_is_negative = 0; ///< "
};

/// The attached lanes (predicates.hpp), for a light on `light_side` of their planes.
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

/// A point in the unit frame, with an error bound of each component.
struct IntervalPoint {
    scene::Vec3d position{};
    double error = 0;
};

/// An `IntervalPoint` for each lane.
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
