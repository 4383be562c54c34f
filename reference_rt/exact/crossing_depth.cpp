#include "reference_rt/exact/crossing_depth.hpp"

#include "reference_rt/exact/terms.hpp"

#include <cmath>
#include <utility>

namespace gnomon::reference_rt {

using scene::Light;
using scene::LightType;
using scene::Vec3d;
using scene::Vec4d;

namespace {

/// plus − minus: keeps a combination of two rows as exact inputs.
struct RowDifference {
    Vec4d plus, minus;
};

/// The side of the crossing of a row's plane.
Sign crossing_side(const Receiver& receiver, const Corners& s, const Light& light,
                   const RowDifference& row, SignCounts& counts)
{
    const bool has_position = light.has_position();
    const auto formula = [&]<typename Field>(Field field) {
        const scene::Ray& ray = receiver.ray();
        const auto axis = difference<Field>(Vec3d{row.plus}, Vec3d{row.minus});
        const auto offset = Field::difference(row.plus.w, row.minus.w);
        const auto [delta, nu] = plane_hit(field, receiver);
        const auto at_point = delta * (dot(axis, vector<Field>(ray.origin)) + offset) +
                              nu * dot(axis, vector<Field>(ray.direction));
        const auto at_light =
            dot(axis, vector<Field>(has_position ? light.position : -light.direction)) +
            Field::number(has_position ? 1.0 : 0.0) * offset;
        const auto normal = normal_of<Field>(s);
        return dot(normal, towards<Field>(light, s[0])) * at_point -
               scaled_side(field, receiver, normal, s[0]) * at_light;
    };
    return receiver.delta_sign * light_side(s, light, counts) *
           sign_of(counts, receiver.is_well_scaled(), formula);
}

} // namespace

bool crosses_in_range(const Receiver& receiver, const Corners& s, const Light& light,
                      const LightDepth& depth, SignCounts& counts)
{
    const ClipRows& rows = depth.rows();
    const Vec4d none{0.0};
    const RowDifference nearer{rows.z, depth.is_reversed() ? none : -rows.w};
    const RowDifference farther{rows.w, rows.z};
    const Sign lower = crossing_side(receiver, s, light, nearer, counts);
    if (lower < 0) {
        return false;
    }
    const Sign upper = crossing_side(receiver, s, light, farther, counts);
    // Their sum is W or 2W, which is positive in front of the light.
    return upper >= 0 && lower + upper > 0;
}

double crossing_parameter(const Receiver& receiver, const Corners& s, const Light& light)
{
    const bool has_position = light.has_position();
    const auto heights = [&]<typename Field>(Field field) {
        const auto normal = normal_of<Field>(s);
        const auto [delta, nu] = plane_hit(field, receiver);
        return std::pair{scaled_side(field, receiver, normal, s[0]),
                         delta * dot(normal, towards<Field>(light, s[0]))};
    };
    if (receiver.is_well_scaled()) {
        const auto [point, change] = heights(FilterField{});
        const Interval height{point.value, point.error()};
        const Interval fall{-change.value, change.error()};
        const Interval way = height / (has_position ? height + fall : fall);
        if (way.error <= 0x1p-42 * std::abs(way.value)) {
            return way.value;
        }
    }
    const auto [height, change] = heights(ExactField{});
    return Dyadic::quotient(height, (has_position ? height : Dyadic{}) - change);
}

} // namespace gnomon::reference_rt
