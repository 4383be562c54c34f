#pragma once

#include "analysis/bias/bias_index.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "analysis/limits/bias_row_inputs.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/lookup/taps.hpp"
#include "methods/lookup_traits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::analysis {

/// A pixel's error, constant over a range of neighbouring biases.
struct ErrorSegment {
    std::size_t first = 0; ///< index among the biases
    std::size_t last = 0;  ///< one behind the last index
    Cause cause = Cause::none;
    Label label = Label::none;
    bool is_wrong = true; ///< false: partial
    /// The amount by which the verdict is wrong, in `ErrorSegments::units`: the taps that count as
    /// `acne` whatever the pixel's label, and the rest.
    std::int64_t acne = 0;
    std::int64_t rest = 1;
    Label rest_label = Label::none;
};

/// The biases at which a pixel is wrong or partial, with cause and amount. Its taps change at their
/// critical biases; a lit pixel's cause changes at the biases at which exact depths repair it.
class ErrorSegments {
public:
    /// @param biases  Ascending; must outlive this, as must the inputs. If the verdicts are given,
    ///                the one bias that they belong to.
    ErrorSegments(const BiasRowInputs& inputs, std::span<const float> biases)
        : inputs_{inputs},
          biases_{biases},
          index_{biases},
          traits_{inputs.rule.traits},
          units_{units_of(traits_)}
    {
    }

    /// The amount of a whole pixel: the number of equal taps, or enough for any fraction.
    [[nodiscard]] static std::int64_t units_of(const methods::LookupTraits& traits)
    {
        constexpr std::int64_t any_fraction = std::int64_t{1} << 32U;
        return traits.equal_taps() > 0 ? traits.equal_taps() : any_fraction;
    }
    [[nodiscard]] std::int64_t units() const { return units_; }

    /// Calls `visit(pixel, segment)` for all segments of the scored pixels in [first, last) for
    /// which `wants(pixel)`.
    template <typename Wants, typename Visit>
    void visit(std::size_t first, std::size_t last, const Wants& wants, const Visit& visit) const
    {
        if (inputs_.taps == nullptr) {
            for (std::size_t pixel = first; pixel != last; ++pixel) {
                if (wants(pixel)) {
                    visit_one_tap(pixel,
                                  [&](const ErrorSegment& segment) { visit(pixel, segment); });
                }
            }
            return;
        }
        const auto is_asked = [&](std::size_t pixel) {
            return scene::is_scored(inputs_.classes[pixel]) && may_err(pixel) && wants(pixel);
        };
        inputs_.taps->visit(
            first, last, is_asked, [&](std::size_t pixel, std::span<const float> criticals) {
                const auto pass = [&](const ErrorSegment& segment) { visit(pixel, segment); };
                if (scene::is_lit(inputs_.classes[pixel])) {
                    visit_lit(pixel, criticals, pass);
                } else {
                    visit_blocked(pixel, criticals, pass);
                }
            });
    }

private:
    /// False if the verdict is given and right.
    [[nodiscard]] bool may_err(std::size_t pixel) const
    {
        const double v{verdict(pixel)};
        const bool is_lit = scene::is_lit(inputs_.classes[pixel]);
        return !inputs_.verdicts_are_given || (is_lit ? 1 - v : v) > partial_above;
    }

    /// A tap, and the index of the first bias that lights it.
    struct TapChange {
        std::size_t lit_from = 0;
        double weight = 1;
        bool is_own = false;
    };
    /// Indices of the biases at which a verdict changes: between right and wrong, and between right
    /// and any error. Errors lie below them (lit pixel) or from them on (blocked pixel).
    struct VerdictChange {
        std::size_t wrong = 0;
        std::size_t error = 0;
    };

    template <typename Pass>
    void visit_one_tap(std::size_t pixel, const Pass& pass) const
    {
        const PixelCause& why = inputs_.causes.pixels[pixel];
        const scene::PixelClass truth = inputs_.classes[pixel];
        const auto add = [&](std::size_t first, std::size_t last, Cause cause, Label label) {
            if (first < last) {
                pass(ErrorSegment{first, last, cause, label, true, 0, 1, label});
            }
        };
        if (scene::is_blocked(truth)) {
            const Cause cause = why.if_wrong == Cause::none ? Cause::bias : why.if_wrong;
            add(index_.first_from(inputs_.critical_bias[pixel]), biases_.size(), cause,
                label_of_blocked(cause, why.sees));
        } else if (scene::is_lit(truth)) {
            const std::size_t change = index_.first_from(inputs_.critical_bias[pixel]);
            if (why.if_wrong == Cause::none) {
                add(0, change, Cause::bias, Label::overshadow);
            } else if (change > 0) {
                const std::size_t middle =
                    std::min(change, first_repaired(pixel, why.exact_critical_bias));
                const ShadowingTaps tap{why.sees ? 1.0 : 0.0, why.sees ? 0.0 : 1.0};
                add(0, middle, why.if_wrong, label_of_lit(why.if_wrong, tap));
                add(middle, change, Cause::precision, label_of_lit(Cause::precision, tap));
            }
        }
    }

    template <typename Pass>
    void visit_lit(std::size_t pixel, std::span<const float> criticals, const Pass& pass) const
    {
        const PixelCause& why = inputs_.causes.pixels[pixel];
        const FilterCause& filter = inputs_.causes.filters[pixel];
        std::array<TapChange, methods::most_taps> changes; // filled as far as it is read
        const std::span<TapChange> taps =
            tap_changes(pixel, criticals, filter.own, std::span{changes});
        const VerdictChange until = lit_until(pixel, taps);
        const std::size_t half = first_repaired(pixel, why.exact_critical_bias);
        const std::size_t full = first_repaired(pixel, filter.exact_full_bias);
        const std::size_t centre = first_repaired_by_centre(pixel, filter, taps);
        ShadowingTaps shadowing;
        for (const TapChange& tap : taps) {
            (tap.is_own ? shadowing.own : shadowing.others) += tap.weight;
        }
        std::size_t next_tap = 0;
        for (std::size_t first = 0; first < until.error;) {
            std::size_t last = until.error;
            for (; next_tap < taps.size() && taps[next_tap].lit_from <= first; ++next_tap) {
                const TapChange& tap = taps[next_tap];
                (tap.is_own ? shadowing.own : shadowing.others) -= tap.weight;
            }
            if (next_tap < taps.size()) {
                last = std::min(last, taps[next_tap].lit_from);
            }
            for (const std::size_t change : {until.wrong, half, full, centre}) {
                last = change > first ? std::min(last, change) : last;
            }
            ErrorSegment segment{first, last, Cause::none, Label::none, first < until.wrong};
            segment.cause =
                lit_cause(why, segment.is_wrong, first, segment.is_wrong ? half : full, centre);
            segment.label = label_of_lit(segment.cause, shadowing);
            divide(pixel, shadowing, segment);
            pass(segment);
            first = last;
        }
    }

    static Cause lit_cause(const PixelCause& why, bool is_wrong, std::size_t bias,
                           std::size_t exact, std::size_t centre)
    {
        const Cause beyond = is_wrong ? why.if_wrong : why.if_partial;
        if (beyond == Cause::none) {
            return Cause::bias;
        }
        return bias >= exact ? Cause::precision : (bias >= centre ? Cause::filter : beyond);
    }

    /// Divides a lit pixel's amount between acne and the rest.
    void divide(std::size_t pixel, const ShadowingTaps& shadowing, ErrorSegment& segment) const
    {
        const double all = shadowing.own + shadowing.others;
        const bool is_by_map = segment.cause != Cause::bias && segment.cause != Cause::coverage;
        segment.rest_label = segment.label;
        segment.rest = units_;
        if (!traits_.has_fractions()) {
            return;
        }
        segment.rest = inputs_.verdicts_are_given ? given_units(1 - double{verdict(pixel)})
                                                  : std::llrint(all); // equal taps have weight 1
        if (is_by_map && all > 0 && adds_taps()) {
            segment.acne = std::llrint(static_cast<double>(segment.rest) * (shadowing.own / all));
            segment.rest -= segment.acne;
            segment.rest_label = Label::edge;
        }
    }

    template <typename Pass>
    void visit_blocked(std::size_t pixel, std::span<const float> criticals, const Pass& pass) const
    {
        const PixelCause& why = inputs_.causes.pixels[pixel];
        std::array<TapChange, methods::most_taps> changes; // filled as far as it is read
        const std::span<TapChange> taps = tap_changes(pixel, criticals, {}, std::span{changes});
        const VerdictChange from = blocked_from(pixel, taps);
        std::size_t lit_taps = 0;
        for (std::size_t first = from.error; first < biases_.size();) {
            std::size_t last = biases_.size();
            for (; lit_taps < taps.size() && taps[lit_taps].lit_from <= first; ++lit_taps) {
            }
            if (lit_taps < taps.size()) {
                last = taps[lit_taps].lit_from;
            }
            last = from.wrong > first ? std::min(last, from.wrong) : last;
            ErrorSegment segment{first, last, Cause::none, Label::none, first >= from.wrong};
            const Cause cause = segment.is_wrong ? why.if_wrong : why.if_partial;
            segment.cause = cause == Cause::none ? Cause::bias : cause;
            segment.label = label_of_blocked(segment.cause, why.sees);
            segment.rest_label = segment.label;
            segment.rest = units_;
            if (traits_.has_fractions()) {
                segment.rest = inputs_.verdicts_are_given ? given_units(double{verdict(pixel)})
                                                          : static_cast<std::int64_t>(lit_taps);
            }
            pass(segment);
            first = last;
        }
    }

    /// The pixel's taps, in the order in which they become lit.
    [[nodiscard]] std::span<TapChange> tap_changes(std::size_t pixel,
                                                   std::span<const float> criticals,
                                                   const TapSet& own,
                                                   std::span<TapChange> changes) const
    {
        std::array<double, methods::most_taps> weights; // filled as far as it is read
        if (traits_.weighs_taps()) {
            inputs_.taps->weights(pixel, weights);
        }
        for (std::size_t t = 0; t < criticals.size(); ++t) {
            changes[t] = {index_.first_from(criticals[t]), traits_.weighs_taps() ? weights[t] : 1.0,
                          own[t]};
        }
        const auto taps = changes.first(criticals.size());
        std::ranges::sort(taps, {}, &TapChange::lit_from);
        return taps;
    }

    [[nodiscard]] VerdictChange lit_until(std::size_t pixel, std::span<const TapChange> taps) const
    {
        if (inputs_.verdicts_are_given) {
            const float v = verdict(pixel);
            return {scene::is_lit(v) ? std::size_t{0} : 1,
                    1 - double{v} > partial_above ? std::size_t{1} : 0};
        }
        if (adds_taps()) {
            return {taps[deciding_rank(taps.size())].lit_from, taps.back().lit_from};
        }
        const std::size_t change = index_.first_from(inputs_.critical_bias[pixel]);
        return {change, change};
    }
    [[nodiscard]] VerdictChange blocked_from(std::size_t pixel,
                                             std::span<const TapChange> taps) const
    {
        if (inputs_.verdicts_are_given) {
            const float v = verdict(pixel);
            return {scene::is_lit(v) ? std::size_t{0} : 1,
                    double{v} > partial_above ? std::size_t{0} : 1};
        }
        if (adds_taps()) {
            return {taps[deciding_rank(taps.size())].lit_from, taps.front().lit_from};
        }
        const std::size_t change = index_.first_from(inputs_.critical_bias[pixel]);
        return {change, change};
    }

    /// Index of the first bias at which the centre texel alone is lit: because its exact depth is,
    /// or because the bias cures all self-shadowing.
    [[nodiscard]] std::size_t first_repaired_by_centre(std::size_t pixel, const FilterCause& filter,
                                                       std::span<const TapChange> taps) const
    {
        const std::size_t exact = first_repaired(pixel, filter.centre_bias);
        if (!filter.centre_is_own) {
            return exact;
        }
        std::size_t cured = 0;
        for (const TapChange& tap : taps) {
            cured = tap.is_own ? std::max(cured, tap.lit_from) : cured;
        }
        return std::min(exact, cured);
    }
    /// Index of the first bias that reaches `exact_critical` together with the slope's part.
    [[nodiscard]] std::size_t first_repaired(std::size_t pixel, float exact_critical) const
    {
        const float slope_term = inputs_.rule.slope * inputs_.deciding.samples[pixel].tan_theta;
        const float scale = inputs_.rule.bias_scale(scene::map_of(inputs_.deciding.maps, pixel));
        if (slope_term == 0 && scale == 1) {
            return index_.first_from(exact_critical);
        }
        const auto first = std::partition_point(biases_.begin(), biases_.end(), [&](float bias) {
            // Reruns over exact depths return a bias that is scaled already.
            const bool is_scaled = !traits_.compares_depths();
            const float whole = is_scaled ? bias + slope_term / scale : bias * scale + slope_term;
            return !(whole >= exact_critical);
        });
        return static_cast<std::size_t>(first - biases_.begin());
    }
    /// Whether verdicts are shares of taps, between 0 and 1.
    [[nodiscard]] bool adds_taps() const
    {
        return traits_.has_fractions() && traits_.is_made_of_taps();
    }
    [[nodiscard]] float verdict(std::size_t pixel) const
    {
        return inputs_.deciding.samples[pixel].verdict;
    }
    [[nodiscard]] std::int64_t given_units(double amount) const
    {
        return std::llrint(amount * static_cast<double>(units_));
    }

    const BiasRowInputs& inputs_;
    std::span<const float> biases_;
    BiasIndex index_;
    const methods::LookupTraits& traits_;
    std::int64_t units_;
};

} // namespace gnomon::analysis
