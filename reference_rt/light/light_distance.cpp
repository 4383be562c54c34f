#include "reference_rt/light/light_distance.hpp"

#include "reference_rt/exact/terms.hpp"
#include "reference_rt/light/texel_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon::reference_rt {

using scene::Vec3d;
using scene::Vec4d;

namespace {

/// The bound is infinite if the root may be that of 0.
Interval root_of(const Interval& square)
{
    const double root = std::sqrt(std::max(square.value, 0.0));
    if (!square.is_certainly_positive()) {
        return {root, std::numeric_limits<double>::infinity()};
    }
    // |√x' − √x| = |x' − x|/(√x' + √x) <= |x' − x|/√x
    return rounded_once(root, 1.01 * square.error / root);
}

DoubleDouble root_of(const DoubleDouble& square)
{
    const double start = std::sqrt(std::max(square.high, 0.0));
    if (!square.rounded().is_certainly_positive()) {
        return {start, 0, std::numeric_limits<double>::infinity()};
    }
    const DoubleDouble rest = square - DoubleDouble{start, 0, 0} * DoubleDouble{start, 0, 0};
    const DoubleDouble root = joined(start, rest.high / (2 * start), 0);
    // |√x' − r| <= |x' − r²|/r. The factor covers the roundings here, the added term covers
    // underflow.
    const Interval remainder = (square - root * root).rounded();
    return {root.high, root.low,
            1.01 * ((std::abs(remainder.value) + remainder.error) / root.high) + 0x1p-1000};
}

/// |P + offset − L|² / far² as a fraction. With P = E + (ν/δ)d both parts are multiplied by δ².
template <typename Field>
auto square_of(Field field, const Receiver& hit, const Vec3d& offset, const Vec3d& light,
               double far_m)
{
    const auto [delta, nu] = plane_hit(field, hit);
    const auto from_light = difference<Field>(hit.ray().origin, light);
    const auto moved = vector<Field>(offset);
    const auto direction = vector<Field>(hit.ray().direction);
    const auto x = delta * (from_light.x + moved.x) + nu * direction.x;
    const auto y = delta * (from_light.y + moved.y) + nu * direction.y;
    const auto z = delta * (from_light.z + moved.z) + nu * direction.z;
    const auto scale = delta * Field::number(far_m);
    return std::pair{x * x + y * y + z * z, scale * scale};
}

/// (W·(P + offset, 1) − o) / (far − o) as a fraction; both parts are multiplied by δ.
template <typename Field>
auto linear_of(Field field, const Receiver& hit, const Vec3d& offset, const Vec4d& axis,
               double origin_m, double far_m)
{
    const auto plane = plane_hit(field, hit);
    const auto origin = Field::number(origin_m);
    const auto span = Field::number(far_m) - origin;
    auto numerator = scaled_row(field, axis, hit.ray(), plane, offset) - plane.delta * origin;
    auto denominator = plane.delta * span;
    return std::pair{std::move(numerator), std::move(denominator)};
}

/// Clamps to [0, 1].
Interval between_ends(const Interval& share)
{
    return {std::clamp(share.value, 0.0, 1.0), share.error};
}

} // namespace

LightDistance::LightDistance(const scene::LightFrustum& frustum)
    : is_root_{traits_of(frustum.content).is_root()},
      light_{frustum.origin},
      axis_{ClipRows{frustum}.w},
      origin_m_{static_cast<float>(traits_of(frustum.content).from_near ? frustum.near_m : 0)},
      far_m_{static_cast<float>(frustum.far_m)}
{
}

Interval LightDistance::at(const Receiver& hit, const Vec3d& offset) const
{
    const scene::Ray& ray = hit.ray();
    const Interval t = parameter_of(hit);
    if (!is_root_) {
        const Interval from_near = plain_row_at(axis_, ray.origin, 1) +
                                   plain_row_at(axis_, offset, 0) - Interval{double{origin_m_}, 0} +
                                   t * plain_row_at(axis_, ray.direction, 0);
        return from_near / (Interval{double{far_m_}, 0} - Interval{double{origin_m_}, 0});
    }
    const auto component = [&](double origin, double moved, double light, double direction) {
        return rounded_once(origin - light, 0) + Interval{moved, 0} + t * Interval{direction, 0};
    };
    const Interval x = component(ray.origin.x, offset.x, light_.x, ray.direction.x);
    const Interval y = component(ray.origin.y, offset.y, light_.y, ray.direction.y);
    const Interval z = component(ray.origin.z, offset.z, light_.z, ray.direction.z);
    return root_of(x * x + y * y + z * z) / Interval{double{far_m_}, 0};
}

DoubleDouble LightDistance::at_double_double(const Receiver& hit, const Vec3d& offset) const
{
    if (!is_root_) {
        const auto [numerator, denominator] =
            linear_of(DoubleDoubleField{}, hit, offset, axis_, double{origin_m_}, double{far_m_});
        return numerator / denominator;
    }
    const auto [numerator, denominator] =
        square_of(DoubleDoubleField{}, hit, offset, light_, double{far_m_});
    return root_of(numerator / denominator);
}

ExactDepth LightDistance::exactly_at(const Receiver& hit, const Vec3d& offset) const
{
    auto [numerator, denominator] =
        is_root_ ? square_of(ExactField{}, hit, offset, light_, double{far_m_})
                 : linear_of(ExactField{}, hit, offset, axis_, double{origin_m_}, double{far_m_});
    return {{std::move(numerator), std::move(denominator)}, is_root_};
}

Interval LightDistance::place(const Receiver& hit) const
{
    constexpr double largest_error = 0x1p-48;
    Interval distance = at(hit);
    if (!(distance.error <= largest_error) && hit.is_well_scaled()) {
        distance = at_double_double(hit).rounded();
    }
    if (!(distance.error <= largest_error)) {
        // Values beyond the ends are clamped, so their error does not matter.
        const ExactDepth exact = exactly_at(hit);
        const double value = exact.is_square ? Root{exact.number}.value() : exact.number.value();
        distance = {std::clamp(value, -1.0, 2.0), largest_error};
    }
    return between_ends(distance);
}

double Root::value() const
{
    return std::sqrt(square.value());
}

Sign Root::sign_beyond(double number) const
{
    const Fraction bound = Fraction::number(number);
    return number < 0 ? 1 : (square - bound * bound).sign();
}

double RootDifference::value() const
{
    return (a - b).value() / (Root{a}.value() + Root{b}.value());
}

Sign RootDifference::sign_beyond(const Fraction& c) const
{
    if (c.sign() < 0) {
        return -RootDifference{b, a}.sign_beyond(Fraction::number(0) - c);
    }
    // Compares √a with √b + c, both not negative: a − (b + c²) with 2c√b, squared if positive.
    const Fraction rest = a - b - c * c;
    if (rest.sign() <= 0) {
        return rest.sign() < 0 || (c * b).sign() > 0 ? -1 : 0;
    }
    return (rest * rest - Fraction::number(4) * (c * c * b)).sign();
}

} // namespace gnomon::reference_rt
