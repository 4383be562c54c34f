#include "scene/light/facing.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gnomon::scene {
namespace {

namespace mp = boost::multiprecision;

/// Holds every step exactly: float32 values are multiples of 2^-149 below 2^128, their differences
/// have 278 bits at most, and products of three differences and sums of six such 837.
using Exact = mp::number<mp::cpp_bin_float<1024, mp::digit_base_2>, mp::et_off>;

using FacedCorners = std::array<Vec3d, 3>;

FacedCorners faced_corners(const TriangleScene& triangles, std::uint32_t triangle)
{
    const auto corners = triangles.corners(triangle);
    return {Vec3d{corners[0]}, Vec3d{corners[1]}, Vec3d{corners[2]}};
}

template <typename Number>
std::array<Number, 3> difference(const Vec3d& a, const Vec3d& b)
{
    return {Number{a.x} - Number{b.x}, Number{a.y} - Number{b.y}, Number{a.z} - Number{b.z}};
}

/// g: from a corner to the light.
template <typename Number>
std::array<Number, 3> to_light(const Light& light, const Vec3d& corner)
{
    return light.has_position() ? difference<Number>(light.position, corner)
                                : difference<Number>(Vec3d{0, 0, 0}, light.direction);
}

/// The six products of ((b − a) × (c − a))·g.
template <typename Number>
std::array<Number, 6> products(const FacedCorners& t, const Light& light)
{
    const auto u = difference<Number>(t[1], t[0]);
    const auto v = difference<Number>(t[2], t[0]);
    const auto g = to_light<Number>(light, t[0]);
    return {u[1] * v[2] * g[0], Number{-(u[2] * v[1] * g[0])},
            u[2] * v[0] * g[1], Number{-(u[0] * v[2] * g[1])},
            u[0] * v[1] * g[2], Number{-(u[1] * v[0] * g[2])}};
}

int exact_sign(const FacedCorners& corners, const Light& light)
{
    Exact sum = 0;
    for (const Exact& product : products<Exact>(corners, light)) {
        sum += product;
    }
    return sum.sign();
}

int sign_of(const FacedCorners& corners, const Light& light)
{
    // Each product has five roundings, of three differences and two products, and takes part in at
    // most five sums: together at most 11 units of 2^-53 of the products' sizes. Nothing
    // underflows: differences are 0 or at least 2^-149.
    constexpr double bound = 16 * 0x1p-53;
    double sum = 0;
    double size = 0;
    for (const double product : products<double>(corners, light)) {
        sum += product;
        size += std::abs(product);
    }
    if (std::abs(sum) > bound * size) {
        return sum > 0 ? 1 : -1;
    }
    return exact_sign(corners, light);
}

} // namespace

std::vector<int> facings(const TriangleScene& triangles, const Light& light)
{
    std::vector<int> signs(triangles.triangles.size());
    for (std::uint32_t t = 0; t < signs.size(); ++t) {
        signs[t] = sign_of(faced_corners(triangles, t), light);
    }
    return signs;
}

} // namespace gnomon::scene
