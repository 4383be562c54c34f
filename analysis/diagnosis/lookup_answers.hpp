#pragma once

#include "analysis/diagnosis/bias_measures.hpp"
#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/diagnosis/lookup_causes.hpp"
#include "analysis/recommendation/minimum_search.hpp"
#include "analysis/recommendation/recommendation.hpp"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Everything about one lookup that does not depend on constant and slope bias. Answers for one
/// bias (a comparison) or many (a sweep). `LookupCauses` finds why pixels are wrong, and
/// `BiasMeasures` the errors at a bias; this class evaluates the curve.
class LookupAnswers {
public:
    LookupAnswers(std::shared_ptr<LightQueryCache> exact, ObservedLookup lookup);
    LookupAnswers(const LookupAnswers&) = delete;
    LookupAnswers& operator=(const LookupAnswers&) = delete;

    [[nodiscard]] LookupCauses& causes() { return causes_; }
    [[nodiscard]] BiasMeasures& measures() { return *measures_; }

    /// The curve of the question's slope, and a row for each of its biases. Precondition: there is
    /// a curve.
    [[nodiscard]] FinishedCurve answer(const CurveQuestion& question);
    /// Finds why the lookup's pixels are wrong at the job's bias, and what other biases would
    /// change. Consumes this object.
    /// @param own           The verdicts at the job's bias.
    /// @param verdict_taps  As in `ComparedLayers`.
    [[nodiscard]] Diagnosis diagnose(const scene::LookupLayers& own,
                                     const DiagnosisRequest& request, int verdict_taps) &&;

private:
    /// The curve with all derived results.
    [[nodiscard]] KnownCurve find_curve(float profile_bias);
    [[nodiscard]] CurveResult describe(const SlopeCurve& curve, float profile_bias);
    /// The fitted properties of the map.
    [[nodiscard]] CurveResult describe_map() const;
    /// All scored pixels at the biases that sample the curve.
    [[nodiscard]] std::vector<CurveSample> draw_curve(const SlopeCurve& curve);
    /// Samples the curve at the biases that GL looks up, and recommends one.
    void sample_curve(const SlopeCurve& curve, CurveResult& result);
    /// A curve of fractions, sampled around its least error.
    struct CurveSamples {
        SampledMinimum minimum;
        std::vector<ErrorAmounts> coarse;       ///< at `coarse_biases`
        std::map<float, MeasuredBias> measured; ///< by bias
    };
    [[nodiscard]] CurveSamples sample_minimum(const SlopeCurve& curve);
    /// The recommendation; empty if no scored pixel is lit.
    [[nodiscard]] std::optional<Recommendation> recommend(const SlopeCurve& curve);
    /// The recommendation for a curve of fractions.
    [[nodiscard]] std::optional<Recommendation>
    recommend_by_amount(const SlopeCurve& curve, const BiasLengths& lengths,
                        const std::optional<BroadMinimum>& broad_minimum);
    /// Converts biases to lengths; empty if no scored pixel is lit.
    [[nodiscard]] std::optional<BiasLengths> bias_lengths(const SlopeCurve& curve) const;
    /// Errors by distance, angle and object, at the job's bias.
    void break_down(const scene::LookupLayers& own, int verdict_taps, Diagnosis& diagnosis) const;

    [[nodiscard]] const scene::Job& job() const { return causes_.lookup().job; }
    [[nodiscard]] const scene::View& view() const { return causes_.lookup().view; }
    [[nodiscard]] const scene::Image<scene::PixelClass>& classes() const
    {
        return causes_.classes();
    }

    LookupCauses causes_;
    std::unique_ptr<BiasMeasures> measures_; ///< refers to the causes
    /// For the job's own slope, if it was found before the texels' hits were freed.
    std::optional<PeterPanningLimit> peter_panning_;
};

} // namespace gnomon::analysis
