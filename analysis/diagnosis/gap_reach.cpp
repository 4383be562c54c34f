#include "analysis/diagnosis/gap_reach.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "methods/job_method.hpp"
#include "scene/infinity.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

/// Whether biases that the curve does not know move the lookup's place alone.
bool moves_place_alone(const scene::Job& job, const scene::View& view)
{
    return !methods::map_offset(job, view) &&
           std::ranges::all_of(methods::active_biases(job, view), [](const auto& bias) {
               return methods::is_of_curve(*bias.term) ||
                      bias.term->place == methods::BiasPlace::lookup_position;
           });
}

std::optional<std::vector<scene::Vec2d>> find_untold(const scene::Job& job, const scene::View& view)
{
    if (!moves_place_alone(job, view)) {
        return std::nullopt;
    }
    std::vector<scene::Vec2d> lengths_m;
    for (std::size_t map = 0; map < view.maps.size(); ++map) {
        const auto at_light_m = methods::normal_offset_m(job, view, map, 0);
        const auto at_metre_m = methods::normal_offset_m(job, view, map, 1);
        if (!at_light_m || !at_metre_m) {
            return std::nullopt;
        }
        lengths_m.emplace_back(*at_light_m, *at_metre_m - *at_light_m);
    }
    return lengths_m;
}

} // namespace

GapReach::GapReach(const GapReachInputs& inputs) : in_{inputs}
{
    if (in_.terms == nullptr) {
        untold_m_ = find_untold(in_.job, in_.view);
    }
}

double GapReach::metres(std::size_t pixel, float constant, float slope) const
{
    const double scale{in_.rule.bias_scale(scene::map_of(in_.lookup.maps, pixel))};
    const double depth = double{constant} * scale +
                         double{slope} * double{in_.lookup.samples[pixel].tan_theta} +
                         nearer(pixel);
    const double length_m =
        bias_length_m(in_.view.maps[map_of(pixel)], depth, double{in_.light_distance_m[pixel]});
    return std::isnan(length_m) ? double{scene::infinity}
                                : moved_m(pixel) + std::max(length_m, 0.0);
}

double GapReach::moved_m(std::size_t pixel) const
{
    if (in_.terms != nullptr) {
        return glm::length(scene::Vec3d{in_.terms->lookup.moved[pixel]});
    }
    if (!untold_m_) {
        return scene::infinity;
    }
    const scene::Vec2d& length_m = (*untold_m_)[map_of(pixel)];
    return std::abs(length_m.x + length_m.y * double{in_.light_distance_m[pixel]});
}

double GapReach::nearer(std::size_t pixel) const
{
    if (in_.terms == nullptr) {
        return 0;
    }
    const scene::LookupTerms& terms = in_.terms->lookup;
    double depth{terms.moved[pixel].w};
    if (!terms.gradients.empty()) {
        const scene::Vec2d gradient{terms.gradients[pixel]};
        const double reach_texels =
            in_.terms->compares_at_once ? 2 : 0.5 * in_.rule.traits.width_texels;
        depth += reach_texels * (std::abs(gradient.x) + std::abs(gradient.y));
    }
    return depth + offset_of_map(pixel);
}

double GapReach::offset_of_map(std::size_t pixel) const
{
    if (!in_.terms->offsets) {
        return 0;
    }
    const scene::LightFrustum& map = in_.view.maps[map_of(pixel)];
    const double depth = std::clamp(
        DepthMapping{map.stored_range()}.depth(double{in_.light_distance_m[pixel]}), 0.0, 1.0);
    const double offset = in_.terms->offsets->at_receiver(scene::map_of(in_.lookup.maps, pixel),
                                                          in_.receivers[pixel], depth);
    return map.reversed ? -offset : offset;
}

} // namespace gnomon::analysis
