#include "reference_rt/rounded/rounding_box.hpp"

#include "reference_rt/traversal/unit_frame.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::reference_rt {

using scene::Vec3d;
using scene::Vec3f;

namespace {

/// Smaller halves would only leave the range of the filter (arithmetic.hpp).
constexpr double smallest_half = 0x1p-96;

double half_spacing(float p)
{
    constexpr int digits = 24;
    return p == 0 ? smallest_half
                  : std::max(smallest_half, std::ldexp(1.0, std::ilogb(std::abs(p)) - digits));
}

/// n·(point − a).
Sign side_of_plane(const ExactTriangle& face, const Vec3d& point, SignCounts& counts)
{
    return sign_of(counts, is_well_scaled(point), [&]<typename Field>(Field) {
        return dot(normal_of<Field>(face.corners), difference<Field>(point, face.corners[0]));
    });
}

/// The corner of the box farthest along the normal, or against it for −1.
Vec3d farthest_corner(const RoundingBox& box, const Vec3d& normal, int side)
{
    unsigned index = 0;
    for (int k = 0; k < 3; ++k) {
        index |= side * normal[k] > 0 ? 1U << static_cast<unsigned>(k) : 0U;
    }
    return box.corner(index);
}

Vec3d rounded_normal(const ExactTriangle& face)
{
    return {face.normal.x.value, face.normal.y.value, face.normal.z.value};
}

bool is_certain(const FilteredNormal& normal)
{
    return normal.x.certain_sign() && normal.y.certain_sign() && normal.z.certain_sign();
}

std::array<Sign, 8> sides_of_corners(const RoundingBox& box, const ExactTriangle& face,
                                     SignCounts& counts)
{
    std::array<Sign, 8> sides{};
    for (unsigned i = 0; i < 8; ++i) {
        sides[i] = side_of_plane(face, box.corner(i), counts);
    }
    return sides;
}

} // namespace

double RoundingBox::reach_m(const Vec3d& point) const
{
    return std::max(largest(upper - point), largest(point - lower));
}

Vec3d RoundingBox::corner(unsigned index) const
{
    const auto component = [&](int k) {
        return (index >> static_cast<unsigned>(k) & 1U) != 0 ? upper[k] : lower[k];
    };
    return {component(0), component(1), component(2)};
}

RoundingBox rounding_box(const Vec3f& p, double growth_m)
{
    RoundingBox box{};
    for (int k = 0; k < 3; ++k) {
        const double half = half_spacing(p[k]) + growth_m;
        const auto centre = static_cast<double>(p[k]);
        box.lower[k] = centre - half;
        box.upper[k] = centre + half;
    }
    return box;
}

bool meets_plane(const RoundingBox& box, const ExactTriangle& face, SignCounts& counts)
{
    const Vec3d normal = rounded_normal(face);
    if (side_of_plane(face, farthest_corner(box, normal, 1), counts) >= 0 &&
        side_of_plane(face, farthest_corner(box, normal, -1), counts) <= 0) {
        return true;
    }
    if (is_certain(face.normal)) {
        return false;
    }
    const auto sides = sides_of_corners(box, face, counts);
    const auto [lowest, highest] = std::minmax_element(sides.begin(), sides.end());
    return *lowest <= 0 && *highest >= 0;
}

double growth_to_plane_m(const Vec3f& p, const ExactTriangle& face, SignCounts& counts)
{
    if (meets_plane(rounding_box(p, 0), face, counts)) {
        return 0;
    }
    const Vec3d n = rounded_normal(face);
    const Vec3d size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    const Vec3d half{half_spacing(p.x), half_spacing(p.y), half_spacing(p.z)};
    const double height = std::abs(glm::dot(n, Vec3d{p} - face.corners[0]));
    const double missing = (height - glm::dot(size, half)) / (size.x + size.y + size.z);
    // A sliver's normal may be inaccurate or zero.
    double growth = 0x1p-30 * largest(half);
    if (missing > growth) {
        growth = missing * (1 + 0x1p-40);
    }
    while (!meets_plane(rounding_box(p, growth), face, counts)) {
        growth *= 2;
    }
    return growth;
}

PlaneSection::PlaneSection(const RoundingBox& box, const ExactTriangle& face, SignCounts& counts)
{
    const auto sides = sides_of_corners(box, face, counts);
    for (int axis = 0; axis < 3; ++axis) {
        const unsigned bit = 1U << static_cast<unsigned>(axis);
        Vec3d direction{0.0};
        direction[axis] = 1;
        for (unsigned i = 0; i < 8; ++i) {
            if ((i & bit) != 0 || sides[i] * sides[i | bit] > 0) {
                continue;
            }
            edges_[count_] = CameraRay{{box.corner(i), direction}};
            corners_[count_] = Receiver{face, edges_[count_], counts};
            // The ends of an edge in the plane are corners of other edges.
            count_ += corners_[count_].delta_sign != 0 ? 1U : 0U;
        }
    }
}

} // namespace gnomon::reference_rt
