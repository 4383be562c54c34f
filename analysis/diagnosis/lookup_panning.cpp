// Finds the pixels whose shadows a bias detaches, from which bias on, and how far.

#include "analysis/diagnosis/lookup_causes.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/bias/kept_terms.hpp"
#include "analysis/depth/depth_mapping.hpp"
#include "analysis/lookup/bias_order.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "methods/job_method.hpp"
#include "scene/image.hpp"
#include "scene/infinity.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Whether the biases outside the curve's formula move only the lookup's position.
bool moves_place_alone(const scene::Job& job, const scene::View& view)
{
    return !methods::map_offset(job, view) &&
           std::ranges::all_of(methods::active_biases(job, view), [](const auto& bias) {
               return methods::is_of_curve(*bias.term) ||
                      bias.term->place == methods::BiasPlace::lookup_position;
           });
}

std::optional<std::vector<scene::Vec2d>> find_unreported(const scene::Job& job,
                                                         const scene::View& view)
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

/// Inputs for the reach of biases.
struct GapReachInputs {
    const scene::Job& job;
    const scene::View& view;
    const LookupRule& rule;
    const scene::LookupLayers& lookup;
    const KeptTerms* terms; ///< null if there are only constant and slope, or if not recorded
    const scene::Image<float>& light_distance_m;
    const scene::Image<std::uint32_t>& receivers;
};

/// How far a lookup's biases can detach a shadow from a receiver: the length of the normal offset,
/// plus that of all depth biases at P.
class GapReach {
public:
    /// The objects that the inputs refer to must outlive this.
    explicit GapReach(const GapReachInputs& inputs);

    /// @param constant, slope  Depth units.
    /// @return  [m]; infinite if the other terms are unknown.
    [[nodiscard]] double metres(std::size_t pixel, float constant, float slope) const;

private:
    /// Displacement of the point that is looked up [m].
    [[nodiscard]] double moved_m(std::size_t pixel) const;
    /// How much the terms besides constant and slope move the receiver's depth towards the light:
    /// the maximum over all taps within the kernel's width.
    [[nodiscard]] double nearer(std::size_t pixel) const;
    [[nodiscard]] double offset_of_map(std::size_t pixel) const;
    [[nodiscard]] std::size_t map_of(std::size_t pixel) const
    {
        return static_cast<std::size_t>(scene::map_of(in_.lookup.maps, pixel));
    }

    GapReachInputs in_;
    /// By map: the length of the normal offset at ζ = 0, and its growth per metre of ζ. For
    /// renderers that do not report their terms; empty if other terms are missing too.
    std::optional<std::vector<scene::Vec2d>> unreported_m_;
};

GapReach::GapReach(const GapReachInputs& inputs) : in_{inputs}
{
    if (in_.terms == nullptr) {
        unreported_m_ = find_unreported(in_.job, in_.view);
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
    if (!unreported_m_) {
        return scene::infinity;
    }
    const scene::Vec2d& length_m = (*unreported_m_)[map_of(pixel)];
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

} // namespace

std::vector<PanningGap> LookupCauses::panning_gaps(const scene::Image<float>& critical,
                                                   float largest_bias)
{
    std::vector<std::size_t> panning;
    for (std::size_t i = 0; i < critical.pixel_count(); ++i) {
        if (scene::is_blocked(classes()[i]) && causes_.pixels[i].if_wrong == Cause::none &&
            critical[i] <= largest_bias) {
            panning.push_back(i);
        }
    }
    const auto lengths = exact_->pixel_gaps(panning, lookup_.layers.maps);
    std::vector<PanningGap> gaps;
    gaps.reserve(panning.size());
    for (std::size_t i = 0; i < panning.size(); ++i) {
        gaps.push_back({critical[panning[i]], lengths[i], panning[i]});
    }
    return gaps;
}

std::vector<Gaps> LookupCauses::gaps_at(const scene::Image<float>& critical, float slope,
                                        std::span<const float> biases)
{
    const GapReach reach{{lookup_.job, lookup_.view, rule_, lookup_.layers,
                          lookup_.terms ? &*lookup_.terms : nullptr, exact_->light_distance_m(),
                          exact_->receivers().receivers().triangle}};
    return find_gaps_at(
        panning_gaps(critical, biases.back()), biases,
        [&](std::size_t pixel, float bias) { return reach.metres(pixel, bias, slope); });
}

void LookupCauses::ask_blocked(std::span<const std::size_t> pixels)
{
    scene::Image<std::uint8_t> asked{classes().size()};
    for (const std::size_t pixel : pixels) {
        asked[pixel] = 1;
    }
    find_blocked_causes(std::move(asked));
}

PeterPanningLimit LookupCauses::find_peter_panning(const scene::Image<float>& critical)
{
    std::vector<std::size_t> lit_at_zero;
    std::vector<std::size_t> above;
    for (std::size_t i = 0; i < critical.pixel_count(); ++i) {
        if (scene::is_blocked(classes()[i]) && critical[i] < scene::infinity) {
            (critical[i] <= 0 ? lit_at_zero : above).push_back(i);
        }
    }
    PeterPanningLimit limit{scene::infinity, 0};
    const auto take = [&](std::span<const std::size_t> pixels) {
        ask_blocked(pixels);
        std::uint64_t others = 0;
        for (const std::size_t pixel : pixels) {
            if (causes_.pixels[pixel].if_wrong == Cause::none) {
                limit.free = std::min(limit.free, previous_bias(critical[pixel]));
            } else {
                ++others;
            }
        }
        return others;
    };
    limit.lit_at_zero = take(lit_at_zero);
    std::size_t piece = 1024; // each call has a fixed cost
    for (std::size_t first = 0; first < above.size() && limit.free == scene::infinity;) {
        const std::size_t last = std::min(first + piece, above.size());
        const auto rest = std::span{above}.subspan(first);
        const auto next = rest.first(last - first);
        std::ranges::partial_sort(rest, next.end(), {},
                                  [&](std::size_t pixel) { return critical[pixel]; });
        take(next);
        first = last;
        piece *= 4;
    }
    return limit;
}

} // namespace gnomon::analysis
