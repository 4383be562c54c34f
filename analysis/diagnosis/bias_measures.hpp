#pragma once

#include "analysis/diagnosis/lookup_causes.hpp"
#include "analysis/limits/slope_curves.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/named_errors.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/results/results.hpp"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

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

/// A slope whose constant biases are measured, and its curve where that is known.
struct MeasuredSlope {
    float slope = 0;
    const SlopeCurve* curve = nullptr;

    MeasuredSlope(float of_slope) : slope{of_slope} {}
    MeasuredSlope(const SlopeCurve& of_curve) : slope{of_curve.slope}, curve{&of_curve} {}
};

/// What each constant bias of a lookup gives, of any slope: by formula, or from GL's own lookups.
/// Biases are ascending, 0 or normal; answers are in their order.
class BiasMeasures {
public:
    BiasMeasures(const BiasMeasures&) = delete;
    BiasMeasures& operator=(const BiasMeasures&) = delete;
    virtual ~BiasMeasures() = default;

    /// Whether GL looks up each bias: then few are asked about.
    [[nodiscard]] virtual bool reruns() const = 0;
    /// The amounts of error at each of the biases, without finding causes.
    [[nodiscard]] virtual std::vector<ErrorAmounts> amounts(MeasuredSlope slope,
                                                            std::span<const float> biases) = 0;
    [[nodiscard]] virtual std::vector<MeasuredBias> measure(MeasuredSlope slope,
                                                            std::span<const float> biases) = 0;
    /// A row of each bias.
    /// @param biases  may be empty.
    [[nodiscard]] virtual std::vector<ConfigurationResult> rows(const SlopeCurve& curve,
                                                                std::span<const float> biases) = 0;
    /// Errors by distance at each of the biases.
    [[nodiscard]] virtual std::vector<std::vector<ErrorBin>>
    profiles(const SlopeCurve& curve, std::span<const float> biases) = 0;
    /// What GL has otherwise than the curves to which its lookups were held; empty: nothing, or GL
    /// was not asked.
    [[nodiscard]] virtual std::optional<BiasVerification> contradictions() const { return {}; }

    /// What is softened with a constant bias of 0.
    [[nodiscard]] Softening softening_at_zero(float slope);
    /// What a constant bias leaves, by name.
    [[nodiscard]] NamedErrors left_by(const SlopeCurve& curve, float bias);

protected:
    /// The errors of one bias, by cause.
    struct CauseSums {
        CauseCounts counts;
        CauseAmounts amounts;
    };

    /// @param causes  must outlive this.
    explicit BiasMeasures(LookupCauses& causes) : causes_{causes} {}

    [[nodiscard]] LookupCauses& causes() const { return causes_; }
    /// The errors by map at a bias, with what each map sees.
    [[nodiscard]] std::vector<MapResult> maps_at(float bias,
                                                 const std::vector<MapErrors>& errors) const;

private:
    [[nodiscard]] virtual CauseSums causes_at(const SlopeCurve& curve, float bias) = 0;
    /// Of a method whose verdicts have fractions.
    [[nodiscard]] virtual Softening find_softening_at_zero(float slope) = 0;

    LookupCauses& causes_;
    std::map<float, Softening> softening_at_zero_; ///< that is known, by slope
};

/// By GL's own lookups where the lookup has reruns, else by formula.
[[nodiscard]] std::unique_ptr<BiasMeasures> make_measures(LookupCauses& causes);

} // namespace gnomon::analysis
