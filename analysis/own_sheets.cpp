#include "analysis/own_sheets.hpp"

#include "analysis/footprint.hpp"

namespace gnomon::analysis {

namespace {

using scene::Filter;
using scene::Outside;

/// Which taps shadow without bias, by the depths that GL stored.
class StoredTaps {
public:
    explicit StoredTaps(const CauseInputs& inputs) : inputs_{inputs}, rules_{inputs.rules()} {}

    [[nodiscard]] bool shadows(std::size_t pixel, const Tap& tap) const
    {
        const Filter filter = inputs_.lookup.filter;
        const bool interpolates = filter == Filter::linear || filter == Filter::hardware;
        if (!tap.is_inside && !interpolates) {
            return inputs_.lookup.outside == Outside::shadowed;
        }
        const float depth =
            tap.is_inside ? inputs_.stored_depth(pixel, tap.texel) : rules_.border_depth();
        return !rules_.is_lit(inputs_.unbiased.samples[pixel].receiver_depth, depth);
    }

private:
    const CauseInputs& inputs_;
    LookupRules rules_;
};

} // namespace

std::vector<bool> sees_own_sheets(const CauseInputs& inputs, const Lookups& lookups,
                                  const TexelHits& hits)
{
    const StoredTaps stored{inputs};
    std::vector<scene::SheetQuery> queries;
    std::vector<std::size_t> lookup_of;
    std::vector<double> weights;
    std::vector<double> balance(lookups.pixels.size()); // own sheet's weight less the others'
    for (std::size_t i = 0; i < lookups.pixels.size(); ++i) {
        for (const Tap& tap : lookups.taps_of(i)) {
            if (!stored.shadows(lookups.pixels[i], tap)) {
                continue;
            }
            balance[i] -= tap.weight;
            const std::uint32_t triangle =
                tap.is_inside ? hits[tap.texel].triangle : scene::no_triangle;
            if (triangle != scene::no_triangle) {
                queries.push_back({lookups.pixels[i], tap.texel, triangle});
                lookup_of.push_back(i);
                weights.push_back(tap.weight);
            }
        }
    }
    const auto own = inputs.light.are_own_sheets(queries);
    std::vector<bool> has_own(lookups.pixels.size());
    for (std::size_t q = 0; q < queries.size(); ++q) {
        if (own[q] != 0) {
            balance[lookup_of[q]] += 2 * weights[q];
            has_own[lookup_of[q]] = true;
        }
    }
    std::vector<bool> sees(lookups.pixels.size());
    for (std::size_t i = 0; i < sees.size(); ++i) {
        sees[i] = has_own[i] && balance[i] >= 0;
    }
    return sees;
}

TracedLookups trace_lookups(const CauseInputs& inputs, std::span<const std::size_t> pixels)
{
    const Footprint footprint{inputs.lookup, inputs.resolution_texels};
    Lookups lookups{{pixels.begin(), pixels.end()}, {}, footprint.tap_count()};
    std::vector<scene::Texel> texels;
    for (const std::size_t pixel : pixels) {
        for (const Tap& tap : footprint.taps(inputs.unbiased.texels[pixel])) {
            lookups.taps.push_back(tap);
            if (tap.is_inside) {
                texels.push_back(tap.texel);
            }
        }
    }
    return {std::move(lookups), TexelHits{inputs.light, texels}};
}

} // namespace gnomon::analysis
