#include "analysis/own_sheets.hpp"

#include "analysis/lookup/footprint.hpp"

#include <utility>

namespace gnomon::analysis {

namespace {

/// Whether a tap shadows without bias, by the depth that GL stored.
bool shadows(const CauseInputs& inputs, std::size_t pixel, const Tap& tap)
{
    const LookupRule rule = inputs.rule();
    const float depth =
        tap.is_inside ? inputs.stored_depth(pixel, tap.texel) : rule.outside_depth();
    return !rule.is_lit(inputs.unbiased.samples[pixel].receiver_depth, depth);
}

/// Weights of a lookup's taps.
struct ShadowShares {
    double own = 0;    ///< of those that shadow without bias and see the receiver's own sheet
    double others = 0; ///< of those that shadow and do not
    double all = 0;
};

std::vector<ShadowShares> shadow_shares(const CauseInputs& inputs, const TracedLookups& lookups)
{
    std::vector<scene::SheetQuery> queries;
    std::vector<std::size_t> lookup_of;
    std::vector<double> weights;
    std::vector<ShadowShares> shares(lookups.size());
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        for (std::size_t t = 0; t < lookups.taps_of(i).size(); ++t) {
            const Tap& tap = lookups.taps_of(i)[t];
            shares[i].all += tap.weight;
            if (!shadows(inputs, lookups.pixel(i), tap)) {
                continue;
            }
            shares[i].others += tap.weight;
            const scene::TexelHit* hit = lookups.hits_of(i)[t];
            if (hit != nullptr && hit->triangle != scene::no_triangle) {
                queries.push_back({lookups.pixel(i), tap.texel, hit->triangle});
                lookup_of.push_back(i);
                weights.push_back(tap.weight);
            }
        }
    }
    const auto own = inputs.light.are_own_sheets(queries);
    for (std::size_t q = 0; q < queries.size(); ++q) {
        if (own[q] != 0) {
            shares[lookup_of[q]].own += weights[q];
            shares[lookup_of[q]].others -= weights[q];
        }
    }
    return shares;
}

} // namespace

std::vector<bool> sees_own_sheets(const CauseInputs& inputs, const TracedLookups& lookups)
{
    std::vector<bool> sees;
    for (const ShadowShares& shares : shadow_shares(inputs, lookups)) {
        sees.push_back(shares.own > 0 && shares.own >= shares.others);
    }
    return sees;
}

TracedLookups trace_lookups(const CauseInputs& inputs, std::span<const std::size_t> pixels)
{
    const Footprint footprint{inputs.lookup, inputs.resolution_texels};
    Lookups lookups{{pixels.begin(), pixels.end()}, {}, footprint.tap_count()};
    for (const std::size_t pixel : pixels) {
        footprint.append_taps(inputs.unbiased.texels[pixel], lookups.taps);
    }
    return {std::move(lookups), inputs.light, inputs.known_hits};
}

std::vector<std::size_t> detached_pixels(const CauseInputs& inputs,
                                         std::span<const std::size_t> pixels)
{
    // Interpolated depths have one comparison, of which a share says nothing.
    const bool is_one_comparison =
        inputs.rule().promises().compares == scene::FilterPromises::Compares::mean_depth;
    const auto shares = shadow_shares(inputs, trace_lookups(inputs, pixels));
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const ShadowShares& share = shares[i];
        const bool is_detached = is_one_comparison ? share.own == 0 || share.own < share.others
                                                   : share.others > 0.5 * share.all;
        if (is_detached) {
            result.push_back(pixels[i]);
        }
    }
    return result;
}

} // namespace gnomon::analysis
