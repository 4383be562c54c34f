#pragma once

#include "analysis/bias/kept_terms.hpp"
#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "analysis/diagnosis/observe_lookup.hpp"
#include "analysis/limits/bias_rows.hpp"
#include "analysis/limits/slope_curves.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/metrics/panning_gaps.hpp"
#include "analysis/rays/light_query_cache.hpp"
#include "analysis/results/results.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// What is found of one bias's verdicts.
struct Explained {
    CauseLayers causes;
    Gaps peter_panning;
    std::vector<ErrorBucket> cells;
};

/// One lookup, and why its pixels are wrong with any constant and slope bias. Causes are found when
/// they are first asked for.
class LookupCauses {
public:
    LookupCauses(std::shared_ptr<LightQueryCache> exact, ObservedLookup lookup);
    LookupCauses(const LookupCauses&) = delete;
    LookupCauses& operator=(const LookupCauses&) = delete;

    /// The lookup; its verdicts are without bias, where that follows from them.
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
    /// Whether verdicts are made of several comparisons, so that amounts are not counts.
    [[nodiscard]] bool has_taps() const { return rule_.traits.equal_taps() > 1; }
    [[nodiscard]] TapCriticals taps(float slope) const
    {
        return {lookup_.layers, lookup_.map_depths, rule_with(slope)};
    }

    /// Whether every constant bias is known.
    [[nodiscard]] bool has_curve() const
    {
        return rule_.traits.has_formula() || lookup_.reruns.has_value();
    }
    /// The critical bias of each pixel: −∞ if every bias is lit, +∞ if none is, 0 without a
    /// receiver. For its argument see `CurveQuestion`.
    /// @throws std::invalid_argument  if there is no curve.
    [[nodiscard]] scene::Image<float> critical_biases(float slope) const;
    /// What curves are made of.
    [[nodiscard]] SlopeInputs curves();

    /// Causes and labels of the same lookup's verdicts with another constant and slope bias.
    [[nodiscard]] CauseLayers causes_of(const scene::LookupLayers& own, float constant,
                                        float slope);
    /// The same, with their gaps and their cells.
    [[nodiscard]] Explained explain(const scene::LookupLayers& own, float constant, float slope);
    /// What `count` makes of what rows of these biases are counted from, the causes of all that is
    /// wrong at any of them included.
    /// @param criticals  of that slope.
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
    /// Peter-panning at each of several constant biases, of one slope.
    /// @param biases  Ascending.
    [[nodiscard]] std::vector<Gaps> gaps_at(const scene::Image<float>& critical, float slope,
                                            std::span<const float> biases);
    /// From which bias on pixels are called peter-panning: blocked ones, in ascending order of
    /// critical bias, are asked for their causes until one is.
    [[nodiscard]] PeterPanningLimit find_peter_panning(const scene::Image<float>& critical);
    /// Finds the causes of lit pixels anew where those known are of other biases: below 0, or not.
    void require_lit_causes(float smallest_bias, float slope);
    /// Hands out what the other bias terms did.
    [[nodiscard]] std::optional<scene::LookupTerms> take_terms();

private:
    [[nodiscard]] CauseInputs cause_inputs() const;
    [[nodiscard]] scene::LookupLayers make_deciding() const;
    [[nodiscard]] PixelCauses no_causes() const;
    /// Makes the lookup one without bias, where it is not moved.
    void remove_bias();
    /// Finds V2 where the method compares no depths: from what exact rays hit, or by running it
    /// over exact depths.
    void rerun_exactly();
    /// The same where the method is run over these depths.
    /// @param bias  that the lookup has; constant and slope matter where no bias is found by
    /// trying.
    [[nodiscard]] ExactReruns run_exactly(const renderers::ExactDepths& depths,
                                          const scene::Bias& bias) const;
    /// @param below_zero  Whether biases below 0 are asked about.
    void find_lit_causes(bool below_zero);
    /// @param reached  1 for blocked pixels that are wrong or partial with some bias asked about.
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
    scene::LookupLayers own_deciding_; ///< pcfK; other lookups decide by the depth they return
    PixelCauses causes_;
    std::optional<ExactReruns> exact_reruns_; ///< empty where depths are compared
    std::optional<scene::Image<std::uint8_t>> missing_receivers_; ///< empty but where triangles are
    bool knows_lit_below_zero_ = false;
    scene::Image<std::uint8_t> knows_blocked_; ///< 1 where the cause of a blocked pixel was found
    scene::Image<float> map_error_m_;
};

} // namespace gnomon::analysis
