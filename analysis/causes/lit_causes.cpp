#include "analysis/causes/find_causes.hpp"

#include "analysis/causes/pixel_squares.hpp"
#include "analysis/causes/traced_lookups.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "methods/lookup_traits.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace gnomon::analysis {

using scene::Outside;

namespace {

class LitCauses {
public:
    LitCauses(const CauseInputs& inputs, PixelCauses& causes, CauseCache* cache)
        : inputs_{inputs},
          causes_{causes},
          cache_{cache},
          rule_{inputs.rule},
          footprint_{inputs.footprint()}
    {
    }

    void find()
    {
        if (cache_ != nullptr) {
            recall();
        }
        explain_in_squares(
            causes_.pixels.size(), footprint_.tap_count(),
            [&](std::size_t pixel) {
                return is_asked(pixel) && (cache_ == nullptr || !cache_->knows(pixel));
            },
            [&](std::span<const std::size_t> pixels) { explain(pixels); });
    }

private:
    /// Whether V1 leaves the pixel wrong or partial.
    [[nodiscard]] bool is_asked(std::size_t pixel) const
    {
        const double shadow = 1 - double{inputs_.unbiased.samples[pixel].verdict};
        return (static_cast<unsigned>(scene::is_lit(inputs_.truth.pixel_class[pixel])) &
                static_cast<unsigned>(shadow > partial_above)) != 0;
    }
    [[nodiscard]] bool is_wrong_unbiased(std::size_t pixel) const
    {
        return !scene::is_lit(inputs_.unbiased.samples[pixel].verdict);
    }

    /// Uses what the cache knows. Has no branches: no processor could predict which pixels are
    /// wrong.
    void recall()
    {
        constexpr PixelCause right;
        for_each_run(causes_.pixels.pixel_count(), [&](std::size_t first, std::size_t last) {
            for (std::size_t pixel = first; pixel != last; ++pixel) {
                causes_.pixels[pixel] = *(is_asked(pixel) ? &cache_->known(pixel) : &right);
            }
        });
    }

    void explain(std::span<const std::size_t> pixels)
    {
        const scene::LookupLayers& layers = inputs_.of_lit();
        std::vector<std::size_t> open;
        std::vector<Tap> taps;
        for (const std::size_t pixel : pixels) {
            // V3: nothing crosses the segment. So only the border mode can shadow, or the map
            // cannot show the receiver itself.
            const bool is_lit = inputs_.is_uncovered(footprint_, pixel)
                                    ? rule_.outside == Outside::lit
                                    : !inputs_.misses_receiver(pixel);
            set(pixel, is_lit ? Cause::resolution : Cause::coverage);
            taps.clear();
            footprint_.append_taps(layers.at(pixel), taps);
            if (!rule_.border_decides(layers.samples[pixel].receiver_depth, taps)) {
                open.push_back(pixel);
                continue;
            }
            const float always = rule_.border_critical_bias();
            causes_.pixels[pixel].exact_critical_bias = always;
            if (!causes_.filters.empty()) {
                causes_.filters[pixel] = {always, always, false, {}};
            }
        }
        explain_by_texels(open);
        if (cache_ != nullptr) {
            for (const std::size_t pixel : pixels) {
                cache_->remember(pixel, causes_.pixels[pixel]);
            }
        }
    }

    /// @param beyond  The cause if neither exact depths nor the centre texel repair it.
    void set(std::size_t pixel, Cause beyond)
    {
        causes_.pixels[pixel].if_wrong = is_wrong_unbiased(pixel) ? beyond : Cause::none;
        causes_.pixels[pixel].if_partial = beyond;
    }

    void explain_by_texels(std::span<const std::size_t> pixels)
    {
        const TracedLookups lookups = trace_lookups(inputs_, inputs_.of_lit(), pixels);
        const bool is_moved = &inputs_.job != &inputs_.of_lit();
        const OwnTaps found =
            is_moved ? find_own(trace_lookups(inputs_, inputs_.job, pixels)) : find_own(lookups);
        const DisplacedLookups displaced = find_displaced(pixels);
        const auto half = exact_biases(lookups, displaced, LitShare::half);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            causes_.pixels[pixels[i]].exact_critical_bias = half[i];
            causes_.pixels[pixels[i]].sees = found.own[i][0];
        }
        if (!causes_.filters.empty()) {
            explain_filter(lookups, displaced, found, half);
        }
    }
    [[nodiscard]] DisplacedLookups find_displaced(std::span<const std::size_t> pixels) const
    {
        const auto* const moved = inputs_.terms != nullptr ? &inputs_.terms->lookup.moved : nullptr;
        return inputs_.exact_reruns != nullptr
                   ? DisplacedLookups{}
                   : analysis::find_displaced(inputs_, inputs_.of_lit(), pixels, moved);
    }

    /// Taps of the job's lookup, and the subset that sees the receiver's self-shadowing surface.
    struct OwnTaps {
        std::vector<TapSet> asked;
        std::vector<TapSet> own;
    };
    [[nodiscard]] OwnTaps find_own(const TracedLookups& lookups) const
    {
        // The cache for a single tap must not depend on stored depths.
        const bool asks_all = inputs_.asks_below_zero || inputs_.rule.traits.has_one_tap();
        const TapSet all = TapSet{}.set() >> (methods::most_taps - inputs_.rule.traits.tap_count());
        auto asked = asks_all ? std::vector<TapSet>(lookups.size(), all)
                              : shadowing_taps(inputs_, inputs_.job, lookups);
        auto own = own_taps(inputs_.light, lookups, asked);
        return {std::move(asked), std::move(own)};
    }

    /// V2: with GL's taps or, where they differ, with those at the exact position.
    [[nodiscard]] std::vector<float> exact_biases(const TracedLookups& lookups,
                                                  const DisplacedLookups& displaced,
                                                  LitShare share) const
    {
        if (inputs_.exact_reruns != nullptr) {
            return rerun_biases(*inputs_.exact_reruns, lookups, share);
        }
        auto biases = exact_critical_biases(comparison(), lookups, share);
        for (const std::size_t i : displaced.of_border) {
            biases[i] = std::min(biases[i], rule_.border_critical_bias());
        }
        if (!displaced.pixels.empty()) {
            const TracedLookups exact = trace_lookups(inputs_, displaced.points, displaced.pixels);
            const auto others = exact_critical_biases(comparison(), exact, share);
            for (std::size_t i = 0; i < others.size(); ++i) {
                float& bias = biases[displaced.indices[i]];
                bias = std::min(bias, others[i]);
            }
        }
        return biases;
    }
    [[nodiscard]] ExactComparison comparison() const
    {
        return {rule_, inputs_.light, inputs_.terms};
    }

    void explain_filter(const TracedLookups& lookups, const DisplacedLookups& displaced,
                        const OwnTaps& found, std::span<const float> half)
    {
        const bool has_fractions = inputs_.rule.traits.has_fractions();
        const auto full = has_fractions ? exact_biases(lookups, displaced, LitShare::full)
                                        : std::vector<float>{half.begin(), half.end()};
        std::vector<std::size_t> centres;
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            centres.push_back(footprint_.centre_tap(inputs_.of_lit().at(lookups.pixel(i))));
        }
        const auto centre = exact_tap_biases(comparison(), lookups, centres);
        std::vector<TapSet> asked(lookups.size());
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            asked[i][centres[i]] = inputs_.asks_below_zero || centre[i] > 0;
        }
        const auto centre_own = own_taps(inputs_.light, lookups, asked);
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            causes_.filters[lookups.pixel(i)] = {full[i], centre[i], centre_own[i].any(),
                                                 found.own[i],
                                                 (found.asked[i] & ~found.own[i]).any()};
        }
    }

    const CauseInputs& inputs_;
    PixelCauses& causes_;
    CauseCache* cache_;
    LookupRule rule_;
    Footprint footprint_;
};

} // namespace

void find_lit_causes(const CauseInputs& inputs, PixelCauses& causes, CauseCache* cache)
{
    require_cause_inputs(inputs);
    LitCauses{inputs, causes, cache}.find();
}

} // namespace gnomon::analysis
