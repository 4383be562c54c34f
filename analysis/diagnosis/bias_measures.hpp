#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/diagnosis/lookup_causes.hpp"
#include "analysis/limits/slope_curves.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/results/results.hpp"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The errors at one constant bias.
struct MeasuredBias {
    float bias = 0; ///< depth units
    Metrics metrics;
    Softening softening;
    Softening at_zero; ///< the softening at a constant bias of 0

    [[nodiscard]] Outcome outcome() const
    {
        return {{metrics.false_shadow, metrics.false_lit},
                metrics.amounts,
                softening.total(),
                left_out(softening, at_zero).total()};
    }
};

/// A slope whose constant biases are measured, and its curve if known.
struct MeasuredSlope {
    float slope = 0;
    const SlopeCurve* curve = nullptr;

    MeasuredSlope(float of_slope) : slope{of_slope} {}
    MeasuredSlope(const SlopeCurve& of_curve) : slope{of_curve.slope}, curve{&of_curve} {}
};

/// Measures the errors of a lookup at constant biases of any slope: by formula, or with GL's own
/// lookups. Biases ascend, and are 0 or normal; results are in their order.
class BiasMeasures {
public:
    BiasMeasures(const BiasMeasures&) = delete;
    BiasMeasures& operator=(const BiasMeasures&) = delete;
    virtual ~BiasMeasures() = default;

    /// Whether GL looks up each bias. Then only few biases should be measured.
    [[nodiscard]] virtual bool reruns() const = 0;
    /// The amounts of error at each of the biases; does not find causes.
    [[nodiscard]] virtual std::vector<ErrorAmounts> amounts(MeasuredSlope slope,
                                                            std::span<const float> biases) = 0;
    [[nodiscard]] virtual std::vector<MeasuredBias> measure(MeasuredSlope slope,
                                                            std::span<const float> biases) = 0;
    /// A row for each bias.
    /// @param biases  May be empty.
    [[nodiscard]] virtual std::vector<ConfigurationResult> rows(const SlopeCurve& curve,
                                                                std::span<const float> biases) = 0;
    /// Errors by distance at each of the biases.
    [[nodiscard]] virtual std::vector<std::vector<ErrorBin>>
    profiles(const SlopeCurve& curve, std::span<const float> biases) = 0;
    /// GL's lookups that contradicted the curves; empty if none did or GL did not look up.
    [[nodiscard]] virtual std::optional<BiasVerification> contradictions() const { return {}; }

    /// The softening at a constant bias of 0.
    [[nodiscard]] Softening softening_at_zero(float slope);
    /// The errors at a constant bias, by cause and label.
    [[nodiscard]] NamedErrors named_errors_at(const SlopeCurve& curve, float bias);

protected:
    /// The errors at one bias, by cause.
    struct CauseSums {
        CauseCounts counts;
        CauseAmounts amounts;
    };

    /// @param causes  Must outlive this.
    explicit BiasMeasures(LookupCauses& causes) : causes_{causes} {}

    [[nodiscard]] LookupCauses& causes() const { return causes_; }
    /// The errors by map at a bias, with the properties of each map.
    [[nodiscard]] std::vector<MapResult> maps_at(float bias,
                                                 const std::vector<MapErrors>& errors) const;

private:
    [[nodiscard]] virtual CauseSums causes_at(const SlopeCurve& curve, float bias) = 0;
    /// For a method whose verdicts have fractions.
    [[nodiscard]] virtual Softening find_softening_at_zero(float slope) = 0;

    LookupCauses& causes_;
    std::map<float, Softening> softening_at_zero_; ///< known values, by slope
};

/// Measures with GL's own lookups if the lookup has reruns, else by formula.
[[nodiscard]] std::unique_ptr<BiasMeasures> make_measures(LookupCauses& causes);

} // namespace gnomon::analysis
