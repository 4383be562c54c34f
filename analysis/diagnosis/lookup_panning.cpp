// Which pixels a bias detaches from their casters, from which bias on, and how far.

#include "analysis/diagnosis/gap_reach.hpp"
#include "analysis/diagnosis/lookup_causes.hpp"
#include "analysis/lookup/bias_order.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

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
    std::size_t piece = 1024; // asking costs something each time
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
