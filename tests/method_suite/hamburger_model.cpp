#include "hamburger_model.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::tests {
namespace {

glm::dmat3 hankel(const Moments& b)
{
    return {1, b.x, b.y, b.x, b.y, b.z, b.y, b.z, b.w};
}

/// One column per moment. Source: code in the supplement of "Moment shadow mapping", 2015.
const glm::dmat4 stored_of_moments{{-2.07224649, 13.7948857237, 0.105877704, 9.7924062118},
                                   {32.23703778, -59.4683975703, -1.9077466311, -33.7652110555},
                                   {-68.571074599, 82.0359750338, 9.3496555107, 47.9456096605},
                                   {39.3703274134, -35.364903257, -6.6543490743, -23.9728048165}};
constexpr double first_offset = 0.035955884801;

} // namespace

Moments biased(const Moments& moments, double moment_bias)
{
    return moments + moment_bias * (Moments{0.5} - moments);
}

double hamburger_light(const Moments& b, double z)
{
    const scene::Vec3d c = glm::inverse(hankel(b)) * scene::Vec3d{1, z, z * z};
    const double half_p = c.y / c.z / 2;
    const double root = std::sqrt(std::max(half_p * half_p - c.x / c.z, 0.0));
    const double nearer = -half_p - root;
    const double farther = -half_p + root;
    // The weight of each depth: the moments' linear functional, applied to its Lagrange polynomial.
    const auto weight = [&](double at, double one, double other) {
        return (one * other - (one + other) * b.x + b.y) / ((at - one) * (at - other));
    };
    double shadow = 0;
    shadow += nearer < z ? weight(nearer, z, farther) : 0;
    shadow += farther < z ? weight(farther, z, nearer) : 0;
    return 1 - std::clamp(shadow, 0.0, 1.0);
}

double least_eigenvalue(const Moments& b)
{
    const double half_trace = (1 + b.y + b.w) / 2;
    return glm::determinant(hankel(b)) / (half_trace * half_trace);
}

bool is_well_conditioned(const Moments& b, double off)
{
    return 3 * off <= least_eigenvalue(b) / 64;
}

LightBound light_bound(const Moments& b, double z, double off)
{
    const double expected = hamburger_light(b, z);
    double apart = 0;
    for (unsigned corner = 0; corner < 32; ++corner) {
        const auto sign = [&](unsigned bit) { return (corner >> bit & 1U) != 0 ? off : -off; };
        const Moments moved = b + Moments{sign(0), sign(1), sign(2), sign(3)};
        apart = std::max(apart, std::abs(hamburger_light(moved, z + sign(4)) - expected));
    }
    const double allowed = 2 * apart + 8 * 0x1p-24;
    return {expected - allowed, expected + allowed};
}

std::array<double, 4> QuantisedMoments::stored(const Moments& moments)
{
    const Moments made = stored_of_moments * moments;
    return {made.x + first_offset, made.y, made.z, made.w};
}

Moments QuantisedMoments::moments(const std::array<double, 4>& stored)
{
    return glm::inverse(stored_of_moments) *
           Moments{stored[0] - first_offset, stored[1], stored[2], stored[3]};
}

std::array<double, 4> QuantisedMoments::sizes()
{
    std::array<double, 4> sums{first_offset, 0, 0, 0};
    for (int row = 0; row < 4; ++row) {
        for (int moment = 0; moment < 4; ++moment) {
            sums.at(static_cast<std::size_t>(row)) += std::abs(stored_of_moments[moment][row]);
        }
    }
    return sums;
}

} // namespace gnomon::tests
