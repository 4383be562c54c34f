#include "reference_rt/light/map_place.hpp"

#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/terms.hpp"
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

/// Rounds down to a float32 that is 0 or normal.
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

/// A receiver's moved point, and half the map's side.
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

/// The map position along one axis.
float place_along(const Vec4d& axis, const Vec4d& w_row, const MovedPoint& point)
{
    const Interval half{point.half_side, 0};
    const Interval plain = half * (plain_row(axis, point) / plain_row(w_row, point)) + half;
    if (const auto place = certainly_rounded<Down>(plain)) {
        return *place;
    }
    if (point.hit.is_well_scaled()) {
        const DoubleDouble wide_half = DoubleDoubleField::number(point.half_side);
        const DoubleDouble ratio = exact_row(DoubleDoubleField{}, axis, point) /
                                   exact_row(DoubleDoubleField{}, w_row, point);
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

/// The largest terms of any point in the box.
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

namespace {

/// Clamps to [0, 1]; the error bound stays valid.
Interval limited(const Interval& x)
{
    return {x.value < 0 ? 0 : x.value > 1 ? 1 : x.value, x.error};
}
DoubleDouble limited(const DoubleDouble& x)
{
    const auto is_beyond_1 = x.high > 1 || (x.high == 1 && x.low > 0);
    return x.high < 0 ? DoubleDouble{0, 0, x.error} : is_beyond_1 ? DoubleDouble{1, 0, x.error} : x;
}
Fraction limited(const Fraction& x)
{
    return x.sign() < 0                           ? Fraction::number(0)
           : (x - Fraction::number(1)).sign() > 0 ? Fraction::number(1)
                                                  : x;
}

/// @param one  the number 1
template <typename Number>
std::array<Number, 4> products(const Number& one, const Number& x, const Number& y)
{
    const Number left = one - x;
    const Number below = one - y;
    return {left * below, x * below, left * y, x * y};
}

} // namespace

std::array<Interval, 4> BilinearWeights::bounded() const
{
    const scene::Ray& ray = hit_.ray();
    const auto row = [&](const scene::Vec4d& of) {
        return plain_row_at(of, ray.origin, 1) + plain_row_at(of, offset_, 0) +
               parameter_of(hit_) * plain_row_at(of, ray.direction, 0);
    };
    const Interval w = row(rows_.w);
    const auto along = [&](const scene::Vec4d& axis, int texel) {
        const Interval n{static_cast<double>(resolution_), 0};
        return limited((n * row(axis) + Interval{base(texel), 0} * w) / (Interval{2, 0} * w));
    };
    return products({1, 0}, along(rows_.x, first_.x), along(rows_.y, first_.y));
}

std::array<DoubleDouble, 4> BilinearWeights::sharp() const
{
    if (!hit_.is_well_scaled()) {
        std::array<DoubleDouble, 4> unknown;
        unknown.fill({0, 0, std::numeric_limits<double>::infinity()});
        return unknown;
    }
    const auto plane = plane_hit(DoubleDoubleField{}, hit_);
    const DoubleDouble w = scaled_row(DoubleDoubleField{}, rows_.w, hit_.ray(), plane, offset_);
    const auto along = [&](const scene::Vec4d& axis, int texel) {
        const DoubleDouble x = scaled_row(DoubleDoubleField{}, axis, hit_.ray(), plane, offset_);
        return limited((DoubleDoubleField::number(resolution_) * x +
                        DoubleDoubleField::number(base(texel)) * w) /
                       (w + w));
    };
    return products(DoubleDoubleField::number(1), along(rows_.x, first_.x),
                    along(rows_.y, first_.y));
}

std::array<Fraction, 4> BilinearWeights::exact() const
{
    const auto plane = plane_hit(ExactField{}, hit_);
    const Dyadic w = scaled_row(ExactField{}, rows_.w, hit_.ray(), plane, offset_);
    const auto along = [&](const scene::Vec4d& axis, int texel) {
        const Dyadic x = scaled_row(ExactField{}, axis, hit_.ray(), plane, offset_);
        const Dyadic n{static_cast<double>(resolution_)};
        return limited(Fraction{n * x + Dyadic{base(texel)} * w, w + w});
    };
    return products(Fraction::number(1), along(rows_.x, first_.x), along(rows_.y, first_.y));
}

} // namespace gnomon::reference_rt
