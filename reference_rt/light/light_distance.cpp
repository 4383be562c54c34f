#include "reference_rt/light/light_distance.hpp"

#include "reference_rt/exact/terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

using scene::Vec3d;

namespace {

/// Nothing is known of the root of what may be 0.
Bounded root_of(const Bounded& square)
{
    const double root = std::sqrt(std::max(square.value, 0.0));
    if (!square.is_certainly_positive()) {
        return {root, std::numeric_limits<double>::infinity()};
    }
    // |√x' − √x| = |x' − x|/(√x' + √x) <= |x' − x|/√x
    return rounded_once(root, 1.01 * square.error / root);
}

Wide root_of(const Wide& square)
{
    const double start = std::sqrt(std::max(square.high, 0.0));
    if (!square.rounded().is_certainly_positive()) {
        return {start, 0, std::numeric_limits<double>::infinity()};
    }
    const Wide rest = square - Wide{start, 0, 0} * Wide{start, 0, 0};
    const Wide root = joined(start, rest.high / (2 * start), 0);
    // |√x' − r| <= |x' − r²|/r; the factor pays for the roundings here, the summand for underflow.
    const Bounded remainder = (square - root * root).rounded();
    return {root.high, root.low,
            1.01 * ((std::abs(remainder.value) + remainder.error) / root.high) + 0x1p-1000};
}

} // namespace

Bounded LightDistance::at(const Receiver& hit) const
{
    const scene::Ray& ray = hit.ray();
    const Bounded t = parameter_of(hit);
    const auto component = [&](double origin, double light, double direction) {
        return rounded_once(origin - light, 0) + t * Bounded{direction, 0};
    };
    const Bounded x = component(ray.origin.x, light_.x, ray.direction.x);
    const Bounded y = component(ray.origin.y, light_.y, ray.direction.y);
    const Bounded z = component(ray.origin.z, light_.z, ray.direction.z);
    return root_of(x * x + y * y + z * z) / Bounded{far_m_, 0};
}

Wide LightDistance::widely_at(const Receiver& hit) const
{
    const auto plane = plane_hit(WideField{}, hit);
    const auto from_light = difference<WideField>(hit.ray().origin, light_);
    const auto direction = vector<WideField>(hit.ray().direction);
    const Wide x = plane.delta * from_light.x + plane.nu * direction.x;
    const Wide y = plane.delta * from_light.y + plane.nu * direction.y;
    const Wide z = plane.delta * from_light.z + plane.nu * direction.z;
    const Wide delta = plane.delta * WideField::number(far_m_);
    return root_of((x * x + y * y + z * z) / (delta * delta));
}

Fraction LightDistance::square_at(const Receiver& hit) const
{
    const auto plane = plane_hit(ExactField{}, hit);
    const auto from_light = difference<ExactField>(hit.ray().origin, light_);
    const auto direction = vector<ExactField>(hit.ray().direction);
    const Dyadic x = plane.delta * from_light.x + plane.nu * direction.x;
    const Dyadic y = plane.delta * from_light.y + plane.nu * direction.y;
    const Dyadic z = plane.delta * from_light.z + plane.nu * direction.z;
    const Dyadic delta = plane.delta * Dyadic{far_m_};
    return {x * x + y * y + z * z, delta * delta};
}

Bounded LightDistance::place(const Receiver& hit) const
{
    constexpr double largest_error = 0x1p-48;
    Bounded distance = at(hit);
    if (!(distance.error <= largest_error) && hit.is_well_scaled()) {
        distance = widely_at(hit).rounded();
    }
    if (!(distance.error <= largest_error)) {
        // Beyond far the size does not matter, nor then its error.
        distance = {std::min(Root{square_at(hit)}.value(), 2.0), largest_error};
    }
    return distance.value > 1 ? Bounded{1, distance.error} : distance;
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

Sign RootDifference::sign_beyond(double number) const
{
    if (number < 0) {
        return -RootDifference{b, a}.sign_beyond(-number);
    }
    // √a against √b + c, both not negative: a − (b + c²) against 2c√b, squared where it is
    // positive.
    const Fraction c = Fraction::number(number);
    const Fraction rest = a - b - c * c;
    if (rest.sign() <= 0) {
        return rest.sign() < 0 || (c * b).sign() > 0 ? -1 : 0;
    }
    return (rest * rest - Fraction::number(4) * (c * c * b)).sign();
}

} // namespace gnomon::reference_rt
