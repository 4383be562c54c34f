#pragma once

#include "analysis/bias/amount_rows.hpp"
#include "analysis/bias/kept_terms.hpp"
#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "analysis/diagnosis/curve_question.hpp"
#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/limits/bias_rows.hpp"
#include "analysis/limits/slope_curves.hpp"
#include "analysis/metrics/panning_gaps.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/rays/exact_light_cache.hpp"
#include "analysis/recommendation/recommendation.hpp"
#include "analysis/recommendation/valley_search.hpp"
#include "analysis/results/results.hpp"
#include "renderers/rasterizer.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// GL, asked again about a lookup whose other biases no formula tells.
struct LookupReruns {
    /// With other constant and slope biases.
    std::function<scene::LookupLayers(float constant, float slope)> look_up;
    /// The critical bias of each pixel, with another slope.
    std::function<scene::Image<float>(float slope)> find_critical_biases;
};

/// The method itself, run over exact depths.
struct ExactRun {
    /// The critical biases (`ExactReruns`), one image for each of `lit_from`. Empty where the
    /// verdict does not rise with the bias.
    /// @param other  biases beside constant and slope, that place the lookup.
    std::function<std::vector<scene::Image<float>>(
        const renderers::ExactDepths&, const scene::Bias& other, std::span<const float> lit_from)>
        find_critical_biases;
    /// The verdicts with each of the biases.
    std::function<std::vector<scene::Image<float>>(const renderers::ExactDepths&,
                                                   std::span<const scene::Bias>)>
        look_up;
    /// Where in each texel (`ExactLight::texel_depths`) the depths are to be.
    std::vector<scene::Vec2d> places = {scene::texel_centre};
    int layers = 1; ///< surfaces of each that are wanted: 2 with the second, at texel centres
};

/// One GL lookup, and what it was made with.
struct ObservedLookup {
    scene::Job job;
    scene::View view;
    scene::LookupLayers layers;          ///< with any constant and slope bias
    scene::LookupLayers unbiased = {};   ///< without any bias; empty where it follows from `layers`
    scene::Image<float> map_depths = {}; ///< as shaders see them; empty for `nearest`
    /// The same of the map without the offset that it was drawn with; empty: there was none.
    scene::Image<float> unbiased_map_depths = {};
    /// What the other bias terms did; empty if the job has only a constant and a slope, or if
    /// nobody recorded it.
    std::optional<KeptTerms> terms = {};
    /// Empty where a formula tells of other biases, or nothing does.
    std::optional<LookupReruns> reruns = {};
    /// Empty where causes are exact.
    std::optional<ExactRun> exact_run = {};
    /// Looks up again with a constant bias of 0, for fractions without a bias curve. Empty: there
    /// is a curve, the bias is 0 already, or nobody recorded such a lookup.
    std::function<ObservedLookup()> without_constant = {};
};

/// Draws what a job's lookups are asked of, or has it.
using DrawnSource = std::function<renderers::Drawn()>;

/// What one constant bias gives.
struct MeasuredBias {
    float bias = 0; ///< depth units
    Metrics metrics;
    Softening softening;
    Softening at_zero; ///< the same with a constant bias of 0

    [[nodiscard]] Outcome outcome() const
    {
        return {{metrics.false_shadow, metrics.false_lit},
                metrics.amounts,
                softening.total(),
                left_out(softening, at_zero).total()};
    }
};

/// Observes what must be known of a lookup beside its layers. What is drawn lives on
/// in the result only where the result looks up again.
/// @param triangles, rasterizer  must outlive what is returned.
[[nodiscard]] ObservedLookup observe_lookup(const scene::Job& job, const scene::View& view,
                                            const scene::TriangleScene& triangles,
                                            scene::LookupLayers layers, const DrawnSource& drawn,
                                            renderers::Rasterizer& rasterizer);

/// Everything about one lookup that does not depend on constant and slope bias; answers for all of
/// them, whoever asks: a comparison for its own, a sweep for many. Without GL where a formula tells
/// of other biases, else by its `LookupReruns`.
class LookupAnswers {
public:
    LookupAnswers(std::shared_ptr<ExactLightCache> exact, ObservedLookup lookup);
    LookupAnswers(const LookupAnswers&) = delete;
    LookupAnswers& operator=(const LookupAnswers&) = delete;

    /// Whether every constant bias is known.
    [[nodiscard]] bool has_curve() const
    {
        return rule_.promises.has_formula() || lookup_.reruns.has_value();
    }
    /// The curve of the question's slope, and a row for each of its biases. Precondition: there is
    /// a curve, as in what follows.
    [[nodiscard]] FinishedCurve answer(const CurveQuestion& question);
    /// The critical bias of each pixel: −∞ if every bias is lit, +∞ if none is, 0 without a
    /// receiver. For its argument see `CurveQuestion`.
    /// @throws std::invalid_argument  if there is no curve.
    [[nodiscard]] scene::Image<float> critical_biases(float slope) const;
    /// What is measured with each of several constant biases, of one slope.
    /// @param biases  Ascending, 0 or normal.
    /// @return  In the order of the biases.
    [[nodiscard]] std::vector<MeasuredBias> measure_biases(float slope,
                                                           std::span<const float> biases);
    /// What is softened with a constant bias of 0.
    [[nodiscard]] Softening softening_at_zero(float slope);
    /// The amounts of error at each of those biases, without finding causes.
    [[nodiscard]] std::vector<ErrorAmounts> amounts_at(float slope,
                                                       std::span<const float> biases) const;
    /// Causes and labels of the same lookup's verdicts with another constant and slope bias.
    [[nodiscard]] CauseLayers causes_of(const scene::LookupLayers& own, float constant,
                                        float slope);
    /// Why the pixels of the same lookup with the job's bias are wrong, and what other biases would
    /// do. Uses this object up: ask nothing more of it.
    /// @param own           verdicts of the job's bias.
    /// @param verdict_taps  as in `ComparedLayers`.
    [[nodiscard]] Diagnosis diagnose(const scene::LookupLayers& own,
                                     const DiagnosisRequest& request, int verdict_taps) &&;

private:
    [[nodiscard]] CauseInputs cause_inputs() const;
    [[nodiscard]] scene::LookupLayers make_deciding() const;
    [[nodiscard]] PixelCauses no_causes() const;
    /// Finds V2 where the method compares no depths: from what exact rays hit, or by running it
    /// over exact depths.
    void rerun_exactly();
    /// The same where the method is run over these depths.
    /// @param bias  that the lookup has; constant and slope matter where no bias is found by
    /// trying.
    [[nodiscard]] ExactReruns run_exactly(const renderers::ExactDepths& depths,
                                          const scene::Bias& bias) const;
    /// Makes the lookup one without bias, where it is not moved.
    void remove_bias();
    /// Finds them anew where what is known is of other biases: below 0, or not.
    void require_lit_causes(float smallest_bias, float slope);
    /// @param below_zero  Whether biases below 0 are asked about.
    void find_lit_causes(bool below_zero);
    /// @param reached  1 for blocked pixels that are wrong or partial with some bias asked about.
    void find_blocked_causes(scene::Image<std::uint8_t> reached);
    [[nodiscard]] scene::Image<std::uint8_t> reached_by(const scene::Image<float>& criticals,
                                                        const TapCriticals& taps,
                                                        float largest_bias) const;
    [[nodiscard]] const scene::LookupLayers& deciding() const
    {
        return own_deciding_.samples.empty() ? lookup_.layers : own_deciding_;
    }
    [[nodiscard]] const scene::Truth& truth() const { return exact_->receivers().truth(); }
    [[nodiscard]] const scene::Image<scene::PixelClass>& classes() const
    {
        return truth().pixel_class;
    }
    /// What curves are made of.
    [[nodiscard]] SlopeInputs curves();
    /// Peter-panning at each of several constant biases, of one slope.
    /// @param biases  Ascending.
    [[nodiscard]] std::vector<Gaps> gaps_at(const scene::Image<float>& critical, float slope,
                                            std::span<const float> biases);
    /// Finds the causes of blocked pixels.
    void ask_blocked(std::span<const std::size_t> pixels);
    /// From which bias on pixels are called peter-panning: blocked ones, in ascending order of
    /// critical bias, are asked for their causes until one is.
    [[nodiscard]] PeterPanningLimit find_peter_panning(const scene::Image<float>& critical);
    [[nodiscard]] std::vector<PanningGap> panning_gaps(const scene::Image<float>& critical,
                                                       float largest_bias);
    /// A row of each bias, ascending.
    [[nodiscard]] std::vector<ConfigurationResult> rows(const SlopeCurve& curve,
                                                        std::span<const float> biases);
    /// The same, each from GL's own lookup.
    [[nodiscard]] std::vector<ConfigurationResult> rerun_rows(const SlopeCurve& curve,
                                                              std::span<const float> biases);
    /// The errors by map at a bias, with what each map sees.
    [[nodiscard]] std::vector<MapResult> maps_at(float bias,
                                                 const std::vector<MapErrors>& errors) const;
    /// GL's own lookup, held to the curve: what it has otherwise is kept in `contradictions_`.
    [[nodiscard]] scene::LookupLayers look_up_again(const SlopeCurve& curve, float bias);
    /// The rule with another slope.
    [[nodiscard]] LookupRule rule_with(float slope) const;
    /// Whether verdicts are made of several comparisons, so that amounts are not counts.
    [[nodiscard]] bool has_taps() const { return rule_.promises.equal_taps() > 1; }
    /// Whether several texels are read.
    [[nodiscard]] bool has_texels() const { return !rule_.promises.has_one_tap(); }
    [[nodiscard]] TapCriticals taps(float slope) const
    {
        return {lookup_.layers, lookup_.map_depths, rule_with(slope)};
    }
    /// @param biases  Ascending.
    [[nodiscard]] std::vector<ErrorAmounts> amounts(const SlopeCurve& curve,
                                                    std::span<const float> biases) const;
    /// What is fitted, whatever the lookup.
    [[nodiscard]] CurveResult describe_map() const;
    [[nodiscard]] CurveResult describe(const SlopeCurve& curve, float profile_bias);
    /// All scored pixels at the biases that a curve is drawn at.
    [[nodiscard]] std::vector<CurveSample> draw_curve(const SlopeCurve& curve) const;
    /// Errors by distance at each of the biases.
    [[nodiscard]] std::vector<std::vector<ErrorBin>> profiles(const SlopeCurve& curve,
                                                              std::span<const float> biases) const;
    /// The same, each from GL's own lookup.
    [[nodiscard]] std::vector<std::vector<ErrorBin>> rerun_profiles(const SlopeCurve& curve,
                                                                    std::span<const float> biases);
    /// What is measured with each of several constant biases.
    /// @param biases  Ascending, 0 or normal.
    [[nodiscard]] std::vector<MeasuredBias> measure(const SlopeCurve& curve,
                                                    std::span<const float> biases);
    /// The same by formula.
    [[nodiscard]] std::vector<MeasuredBias> measure_by_formula(const SlopeCurve& curve,
                                                               std::span<const float> biases);
    /// GL's own lookup with a constant bias.
    using LookUp = std::function<scene::LookupLayers(float bias)>;
    /// The same, each from GL's own lookup.
    [[nodiscard]] std::vector<MeasuredBias> rerun(float slope, std::span<const float> biases,
                                                  const LookUp& look_up);
    /// Its amounts, without finding causes.
    [[nodiscard]] std::vector<ErrorAmounts> rerun_amounts(std::span<const float> biases,
                                                          const LookUp& look_up) const;
    /// Lookups of a slope.
    [[nodiscard]] LookUp lookups_with(float slope) const;
    /// Those of a curve, which are held to it.
    [[nodiscard]] LookUp lookups_held_to(const SlopeCurve& curve);
    /// Draws the curve at the biases that GL looks up, and recommends one of them.
    void sample_curve(const SlopeCurve& curve, CurveResult& result);
    /// A curve of fractions, tried around its least error.
    struct TriedCurve {
        TriedValley tried;
        std::vector<ErrorAmounts> coarse;       ///< of `coarse_biases`
        std::map<float, MeasuredBias> measured; ///< by bias
    };
    [[nodiscard]] TriedCurve try_biases(const SlopeCurve& curve);
    /// What is recommended; empty if no scored pixel is lit.
    [[nodiscard]] std::optional<Recommendation> recommend(const SlopeCurve& curve);
    /// The same of fractions.
    [[nodiscard]] std::optional<Recommendation>
    recommend_by_amount(const SlopeCurve& curve, const BiasLengths& lengths,
                        const std::optional<BiasValley>& valley);
    /// Where biases are made lengths; empty if no scored pixel is lit.
    [[nodiscard]] std::optional<BiasLengths> bias_lengths(const SlopeCurve& curve) const;
    /// What is softened on purpose with each of several biases.
    /// @param criticals  of that slope.
    /// @param biases     Ascending.
    [[nodiscard]] std::vector<Softening> softening_with(float slope,
                                                        const scene::Image<float>& criticals,
                                                        std::span<const float> biases);
    /// What is found of one bias's verdicts.
    struct Explained {
        CauseLayers causes;
        Gaps peter_panning;
        std::vector<ErrorCell> cells;
    };
    /// What a constant bias leaves, by name.
    [[nodiscard]] NamedErrors left_by(const SlopeCurve& curve, float bias);
    /// The curve, and what follows from it.
    [[nodiscard]] KnownCurve find_curve(float profile_bias);
    /// Causes and gaps of the lookup's verdicts with these biases.
    [[nodiscard]] Explained explain(const scene::LookupLayers& own, float constant, float slope);
    /// Errors by distance, angle and object, at the job's bias.
    void break_down(const scene::LookupLayers& own, int verdict_taps, Diagnosis& diagnosis) const;

    std::shared_ptr<ExactLightCache> exact_;
    ObservedLookup lookup_;
    LookupRule rule_;
    scene::LookupLayers own_deciding_; ///< pcfK; other lookups decide by the depth they return
    PixelCauses causes_;
    std::optional<ExactReruns> exact_reruns_; ///< empty where depths are compared
    std::optional<scene::Image<std::uint8_t>> missing_receivers_; ///< empty but where triangles are
    bool knows_lit_below_zero_ = false;
    scene::Image<std::uint8_t> knows_blocked_; ///< 1 where the cause of a blocked pixel was found
    scene::Image<float> map_error_m_;
    std::map<float, Softening> softening_at_zero_; ///< that is known, by slope
    /// Of the job's own slope, where it was found while what the rays saw was still known.
    std::optional<PeterPanningLimit> peter_panning_;
    std::optional<BiasVerification> contradictions_; ///< reruns that are not the curve's
};

} // namespace gnomon::analysis
