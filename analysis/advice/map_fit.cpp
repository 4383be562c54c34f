#include "analysis/advice/map_fit.hpp"

#include "analysis/pixels/receiver_geometry.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon::analysis {

std::string fit_setting(scene::Fit own, scene::Fit fit)
{
    const bool replaces_fixed = own == scene::Fit::fixed && fit != scene::Fit::fixed;
    return fmt::format("fit = \"{}\"{}", scene::fit_name(fit),
                       replaces_fixed ? " # and remove half_extent or fov_deg" : "");
}

namespace {

/// Rounds up to two digits, to the nearest double, so that it prints with two digits.
double rounded_up(double length_m)
{
    const int exponent = static_cast<int>(std::floor(std::log10(length_m))) - 1;
    const double digits = std::ceil(length_m / std::pow(10.0, exponent));
    return exponent < 0 ? digits / std::pow(10.0, -exponent) : digits * std::pow(10.0, exponent);
}

} // namespace

double reach_of_shadows_m(const scene::TriangleScene& triangles, const scene::View& view,
                          const scene::Image<std::uint32_t>& triangle,
                          const scene::Image<scene::PixelClass>& classes)
{
    const scene::LightFrustum& frustum = view.first_map();
    const ReceiverGeometry geometry{triangles, view, triangle};
    double reach_m = 0;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_blocked(classes[i])) {
            const scene::Vec3d from_middle = geometry.point(i) - frustum.origin;
            reach_m = std::max({reach_m, std::abs(glm::dot(from_middle, frustum.right)),
                                std::abs(glm::dot(from_middle, frustum.up))});
        }
    }
    return reach_m;
}

std::optional<double> half_extent_m(double reach_m, const scene::LightFrustum& whole)
{
    constexpr double to_spare = 1.1;
    const double side_m = std::max(whole.right_side - whole.left, whole.top - whole.bottom);
    const bool is_smaller = reach_m > 0 && 2 * to_spare * reach_m < side_m / 2;
    return is_smaller ? std::optional{rounded_up(to_spare * reach_m)} : std::nullopt;
}

} // namespace gnomon::analysis
