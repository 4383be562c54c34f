#pragma once

#include "analysis/diagnosis/bias_measures.hpp"
#include "analysis/diagnosis/curve_question.hpp"
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

/// Everything about one lookup that does not depend on constant and slope bias; answers for all of
/// them, whoever asks: a comparison for its own, a sweep for many. Why pixels are wrong is found by
/// `LookupCauses`, what a bias gives by `BiasMeasures`; here is what the curve says of both.
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
    /// Why the pixels of the same lookup with the job's bias are wrong, and what other biases would
    /// do. Uses this object up: ask nothing more of it.
    /// @param own           verdicts of the job's bias.
    /// @param verdict_taps  as in `ComparedLayers`.
    [[nodiscard]] Diagnosis diagnose(const scene::LookupLayers& own,
                                     const DiagnosisRequest& request, int verdict_taps) &&;

private:
    /// The curve, and what follows from it.
    [[nodiscard]] KnownCurve find_curve(float profile_bias);
    [[nodiscard]] CurveResult describe(const SlopeCurve& curve, float profile_bias);
    /// What is fitted, whatever the lookup.
    [[nodiscard]] CurveResult describe_map() const;
    /// All scored pixels at the biases that a curve is drawn at.
    [[nodiscard]] std::vector<CurveSample> draw_curve(const SlopeCurve& curve);
    /// Draws the curve at the biases that GL looks up, and recommends one of them.
    void sample_curve(const SlopeCurve& curve, CurveResult& result);
    /// A curve of fractions, tried around its least error.
    struct TriedCurve {
        TriedMinimum tried;
        std::vector<ErrorAmounts> coarse;       ///< of `coarse_biases`
        std::map<float, MeasuredBias> measured; ///< by bias
    };
    [[nodiscard]] TriedCurve try_biases(const SlopeCurve& curve);
    /// What is recommended; empty if no scored pixel is lit.
    [[nodiscard]] std::optional<Recommendation> recommend(const SlopeCurve& curve);
    /// The same of fractions.
    [[nodiscard]] std::optional<Recommendation>
    recommend_by_amount(const SlopeCurve& curve, const BiasLengths& lengths,
                        const std::optional<BroadMinimum>& broad_minimum);
    /// Where biases are made lengths; empty if no scored pixel is lit.
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
    /// Of the job's own slope, where it was found while what the rays saw was still known.
    std::optional<PeterPanningLimit> peter_panning_;
};

} // namespace gnomon::analysis
