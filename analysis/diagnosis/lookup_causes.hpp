#pragma once

#include "analysis/bias/kept_terms.hpp"
#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "analysis/diagnosis/observe_lookup.hpp"
#include "analysis/limits/bias_rows.hpp"
#include "analysis/limits/slope_curves.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/rays/light_query_cache.hpp"
#include "analysis/results/results.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The explanation of the verdicts at one bias.
struct ExplainedVerdicts {
    CauseLayers causes;
    Gaps peter_panning;
    std::vector<ErrorBucket> cells;
};

/// One lookup, and why its pixels are wrong at any constant and slope bias. Finds causes on first
/// use.
class LookupCauses {
public:
    LookupCauses(std::shared_ptr<LightQueryCache> exact, ObservedLookup lookup);
    LookupCauses(const LookupCauses&) = delete;
    LookupCauses& operator=(const LookupCauses&) = delete;

    /// The lookup. Its verdicts are unbiased if they can be derived.
    [[nodiscard]] const ObservedLookup& lookup() const { return lookup_; }
    [[nodiscard]] LightQueryCache& exact() const { return *exact_; }
    [[nodiscard]] const LookupRule& rule() const { return rule_; }
    [[nodiscard]] const methods::LookupTraits& traits() const { return rule_.traits; }
    [[nodiscard]] const scene::Truth& truth() const { return exact_->receivers().truth(); }
    [[nodiscard]] const scene::Image<scene::PixelClass>& classes() const
    {
        return truth().pixel_class;
    }
    /// The samples that decide which bias lights a pixel.
    [[nodiscard]] const scene::LookupLayers& deciding() const
    {
        return own_deciding_.samples.empty() ? lookup_.layers : own_deciding_;
    }
    /// `map_depth_errors_m`.
    [[nodiscard]] const scene::Image<float>& map_error_m() const { return map_error_m_; }
    /// Whether verdicts combine several comparisons, so that amounts differ from counts.
    [[nodiscard]] bool has_taps() const { return rule_.traits.equal_taps() > 1; }
    [[nodiscard]] TapCriticals taps(float slope) const
    {
        return {lookup_.layers, lookup_.map_depths, rule_with(slope)};
    }

    /// Whether every constant bias can be evaluated.
    [[nodiscard]] bool has_curve() const
    {
        return rule_.traits.has_formula() || lookup_.reruns.has_value();
    }
    /// The critical bias of each pixel: −∞ if every bias is lit, +∞ if none is, 0 without a
    /// receiver. For the argument, see `CurveQuestion`.
    /// @throws std::invalid_argument  if there is no curve.
    [[nodiscard]] scene::Image<float> critical_biases(float slope) const;
    /// The inputs of slope curves.
    [[nodiscard]] SlopeInputs curves();

    /// Causes and labels of this lookup's verdicts at another constant and slope bias.
    [[nodiscard]] CauseLayers causes_of(const scene::LookupLayers& own, float constant,
                                        float slope);
    /// As `causes_of`, with gaps and error buckets.
    [[nodiscard]] ExplainedVerdicts explain(const scene::LookupLayers& own, float constant,
                                            float slope);
    /// Returns `count(inputs)`, with the inputs for counting rows at these biases. They include the
    /// causes of all pixels that are wrong at any of them.
    /// @param criticals  At that slope.
    /// @param biases     Ascending, at least one.
    template <typename Count>
    auto count_at(const scene::Image<float>& criticals, float slope, std::span<const float> biases,
                  const Count& count)
    {
        require_lit_causes(biases.front(), slope);
        const TapCriticals taps_of_slope = taps(slope);
        find_blocked_causes(reached_by(criticals, taps_of_slope, biases.back()));
        return count(BiasRowInputs{classes(), deciding(), criticals, causes_, rule_with(slope),
                                   has_texels() ? &taps_of_slope : nullptr});
    }
    /// Peter-panning at each of several constant biases of one slope.
    /// @param biases  Ascending.
    [[nodiscard]] std::vector<Gaps> gaps_at(const scene::Image<float>& critical, float slope,
                                            std::span<const float> biases);
    /// Finds the bias from which on pixels are peter-panning: finds causes of blocked pixels in
    /// ascending order of critical bias until one is.
    [[nodiscard]] PeterPanningLimit find_peter_panning(const scene::Image<float>& critical);
    /// Finds the causes of lit pixels again if the known ones are for other biases (below 0 or
    /// not).
    void require_lit_causes(float smallest_bias, float slope);
    /// Moves out the effect of the other bias terms.
    [[nodiscard]] std::optional<scene::LookupTerms> take_terms();

private:
    [[nodiscard]] CauseInputs cause_inputs() const;
    [[nodiscard]] scene::LookupLayers make_deciding() const;
    [[nodiscard]] PixelCauses no_causes() const;
    /// Removes the bias from the lookup, if none moved it.
    void remove_bias();
    /// Finds V2 of a method that does not compare depths: from exact hits, or by running it over
    /// exact depths.
    void rerun_exactly();
    /// Runs the method over these depths.
    /// @param bias  The lookup's. Constant and slope matter if the critical bias cannot be found by
    ///              trying biases.
    [[nodiscard]] ExactReruns run_exactly(const renderers::ExactDepths& depths,
                                          const scene::Bias& bias) const;
    /// @param below_zero  Whether biases below 0 matter.
    void find_lit_causes(bool below_zero);
    /// @param reached  1 for blocked pixels that are wrong or partial at some bias in question.
    void find_blocked_causes(scene::Image<std::uint8_t> reached);
    [[nodiscard]] scene::Image<std::uint8_t> reached_by(const scene::Image<float>& criticals,
                                                        const TapCriticals& taps,
                                                        float largest_bias) const;
    /// Finds the causes of blocked pixels.
    void ask_blocked(std::span<const std::size_t> pixels);
    [[nodiscard]] std::vector<PanningGap> panning_gaps(const scene::Image<float>& critical,
                                                       float largest_bias);
    /// The rule with another slope.
    [[nodiscard]] LookupRule rule_with(float slope) const;
    /// Whether several texels are read.
    [[nodiscard]] bool has_texels() const { return !rule_.traits.has_one_tap(); }

    std::shared_ptr<LightQueryCache> exact_;
    ObservedLookup lookup_;
    LookupRule rule_;
    scene::LookupLayers own_deciding_; ///< pcfK only; other lookups decide by the depth they return
    PixelCauses causes_;
    std::optional<ExactReruns> exact_reruns_; ///< empty if the method compares depths
    /// Empty unless the method compares triangles.
    std::optional<scene::Image<std::uint8_t>> missing_receivers_;
    bool knows_lit_below_zero_ = false;
    scene::Image<std::uint8_t> knows_blocked_; ///< 1 where the cause of a blocked pixel is known
    scene::Image<float> map_error_m_;
};

} // namespace gnomon::analysis
