#include "reference_rt/light/map_place.hpp"

#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/terms.hpp"
#include "reference_rt/exact/wide.hpp"
#include "reference_rt/light/float_rounding.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "scene/infinity.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

using scene::Vec3d;
using scene::Vec4d;

namespace {

/// Down to the next float32 that is 0 or normal.
struct Down {
    static float of(double x)
    {
        constexpr double smallest_normal{std::numeric_limits<float>::min()};
        if (x > -smallest_normal && x < smallest_normal) {
            return x < 0 ? -std::numeric_limits<float>::min() : 0.0F;
        }
        const auto nearest = static_cast<float>(x);
        return static_cast<double>(nearest) > x ? std::nextafter(nearest, -scene::infinity)
                                                : nearest;
    }
    static double boundary(float /*lower*/, float upper) { return static_cast<double>(upper); }
};

/// A point of a receiver's ray, moved; and half the map's side.
struct MovedPoint {
    const Receiver& hit;
    const Vec3d& offset;
    double half_side; ///< [texels]
};

Interval plain_row(const Vec4d& row, const MovedPoint& point)
{
    const scene::Ray& ray = point.hit.ray();
    const Interval start = plain_row_at(row, ray.origin, 1) + plain_row_at(row, point.offset, 0);
    return start + parameter_of(point.hit) * plain_row_at(row, ray.direction, 0);
}

template <typename Field>
auto exact_row(Field field, const Vec4d& row, const MovedPoint& point)
{
    return scaled_row(field, row, point.hit.ray(), plane_hit(field, point.hit), point.offset);
}

/// Along the axis of a row.
float place_along(const Vec4d& axis, const Vec4d& w_row, const MovedPoint& point)
{
    const Interval half{point.half_side, 0};
    const Interval plain = half * (plain_row(axis, point) / plain_row(w_row, point)) + half;
    if (const auto place = certainly_rounded<Down>(plain)) {
        return *place;
    }
    if (point.hit.is_well_scaled()) {
        const Wide wide_half = WideField::number(point.half_side);
        const Wide ratio =
            exact_row(WideField{}, axis, point) / exact_row(WideField{}, w_row, point);
        if (const auto place = certainly_rounded<Down>(wide_half * ratio + wide_half)) {
            return *place;
        }
    }
    const Dyadic w = exact_row(ExactField{}, w_row, point);
    if (w.sign() == 0) {
        return std::numeric_limits<float>::quiet_NaN();
    }
    const Dyadic x = exact_row(ExactField{}, axis, point);
    return exactly_rounded<Down>(Fraction{Dyadic{point.half_side} * (x + w), w});
}

/// Of any point of the box.
double largest_terms(const Vec4d& row, const Vec3d& farthest)
{
    return std::abs(row.x) * farthest.x + std::abs(row.y) * farthest.y +
           std::abs(row.z) * farthest.z + std::abs(row.w);
}

} // namespace

scene::Vec2f map_place(const ClipRows& rows, const Receiver& hit, const Vec3d& offset,
                       int resolution_texels)
{
    if (hit.delta_sign == 0) {
        return scene::Vec2f{std::numeric_limits<float>::quiet_NaN()};
    }
    const MovedPoint point{hit, offset, 0.5 * resolution_texels};
    return {place_along(rows.x, rows.w, point), place_along(rows.y, rows.w, point)};
}

double place_error_texels(const scene::LightFrustum& map, const scene::Box& box,
                          int resolution_texels)
{
    const ClipRows rows{map};
    const Vec3d farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    const double across =
        std::max(largest_terms(rows.x, farthest), largest_terms(rows.y, farthest));
    const double smallest_w = map.projection == scene::Projection::perspective ? map.near_m : 1.0;
    const double terms = (across + largest_terms(rows.w, farthest)) / smallest_w;
    return 256 * 0x1p-24 * 0.5 * resolution_texels * terms;
}

} // namespace gnomon::reference_rt
