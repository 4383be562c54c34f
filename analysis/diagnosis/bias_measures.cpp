#include "analysis/diagnosis/bias_measures.hpp"

#include "analysis/bias/amount_rows.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/metrics/map_depth_errors.hpp"
#include "analysis/metrics/map_results.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace gnomon::analysis {

Softening BiasMeasures::softening_at_zero(float slope)
{
    if (!causes_.traits().has_fractions()) {
        return {};
    }
    const auto known = softening_at_zero_.find(slope);
    return known != softening_at_zero_.end()
               ? known->second
               : softening_at_zero_.emplace(slope, find_softening_at_zero(slope)).first->second;
}

NamedErrors BiasMeasures::named_errors_at(const SlopeCurve& curve, float bias)
{
    const CauseSums left = causes_at(curve, bias);
    const Softening own{left.amounts.shadow_softening, left.amounts.light_softening};
    return named_errors(left.counts, left.amounts, causes_.traits().has_fractions(),
                        left_out(own, softening_at_zero(curve.slope)).total());
}

std::vector<MapResult> BiasMeasures::maps_at(float bias, const std::vector<MapErrors>& errors) const
{
    if (errors.empty()) {
        return {};
    }
    scene::View view = causes_.lookup().view;
    view.bias.constant = bias;
    return results_of_maps(causes_.lookup().job, view, errors);
}

namespace {

class FormulaMeasures final : public BiasMeasures {
public:
    explicit FormulaMeasures(LookupCauses& causes) : BiasMeasures{causes} {}

    [[nodiscard]] bool reruns() const override { return false; }

    [[nodiscard]] std::vector<ErrorAmounts> amounts(MeasuredSlope slope,
                                                    std::span<const float> biases) override
    {
        const auto& classes = causes().classes();
        if (causes().has_taps()) {
            return sum_amounts(classes, causes().taps(slope.slope), biases);
        }
        return slope.curve != nullptr
                   ? sum_amounts(slope.curve->curve, biases)
                   : sum_amounts(BiasCurve{causes().critical_biases(slope.slope), classes}, biases);
    }

    [[nodiscard]] std::vector<MeasuredBias> measure(MeasuredSlope slope,
                                                    std::span<const float> biases) override
    {
        if (slope.curve != nullptr) {
            return measure(slope.slope, slope.curve->critical_bias, slope.curve->curve,
                           amounts(slope, biases), biases);
        }
        const scene::Image<float> criticals = causes().critical_biases(slope.slope);
        const BiasCurve curve{criticals, causes().classes()};
        return measure(slope.slope, criticals, curve,
                       causes().has_taps() ? amounts(slope, biases) : sum_amounts(curve, biases),
                       biases);
    }

    [[nodiscard]] std::vector<ConfigurationResult> rows(const SlopeCurve& curve,
                                                        std::span<const float> biases) override
    {
        if (biases.empty()) {
            return {};
        }
        return causes().count_at(
            curve.critical_bias, curve.slope, biases,
            [&](const BiasRowInputs& inputs) { return rows(curve, inputs, biases); });
    }

    [[nodiscard]] std::vector<std::vector<ErrorBin>>
    profiles(const SlopeCurve& curve, std::span<const float> biases) override
    {
        const BreakdownInputs inputs{causes().truth(), causes().deciding(), curve.critical_bias,
                                     causes().map_error_m(), causes().traits().equal_taps()};
        return errors_by_bin(
            causes().exact().distances(), inputs, biases,
            causes().has_taps()
                ? count_lit_taps(causes().classes(), causes().taps(curve.slope), biases)
                : std::vector<scene::Image<std::uint8_t>>{});
    }

private:
    [[nodiscard]] std::vector<MeasuredBias>
    measure(float slope, const scene::Image<float>& criticals, const BiasCurve& curve,
            const std::vector<ErrorAmounts>& amounts_of, std::span<const float> biases)
    {
        const auto softening = softening_with(slope, criticals, biases);
        std::vector<MeasuredBias> measured;
        for (std::size_t i = 0; i < biases.size(); ++i) {
            const ErrorCounts errors = curve.at(biases[i]);
            measured.push_back(
                {biases[i],
                 make_metrics(causes().exact().receivers().classes(),
                              {errors.false_shadow, errors.false_lit, amounts_of[i]}),
                 softening[i], softening_at_zero(slope)});
        }
        return measured;
    }

    [[nodiscard]] std::vector<ConfigurationResult>
    rows(const SlopeCurve& curve, const BiasRowInputs& inputs, std::span<const float> biases)
    {
        const scene::MapIndices& maps = causes().lookup().layers.maps;
        const auto errors_by = amounts(curve, biases);
        const auto counts = count_rows(inputs, curve.curve, errors_by, biases);
        const auto cells = count_error_buckets(causes().exact().cells(), inputs, biases);
        const auto by_map =
            count_map_errors(maps, causes().lookup().view.maps.size(), inputs, biases);
        const auto gaps = causes().gaps_at(curve.critical_bias, curve.slope, biases);
        std::vector<ConfigurationResult> rows;
        for (std::size_t i = 0; i < biases.size(); ++i) {
            const ErrorCounts& errors = counts[i].errors;
            rows.push_back({make_metrics(causes().exact().receivers().classes(),
                                         {errors.false_shadow, errors.false_lit, errors_by[i]}),
                            counts[i].causes, counts[i].amounts, gaps[i], cells[i],
                            maps_at(biases[i], by_map[i])});
        }
        return rows;
    }

    [[nodiscard]] std::vector<Softening>
    softening_with(float slope, const scene::Image<float>& criticals, std::span<const float> biases)
    {
        return causes().count_at(criticals, slope, biases, [&](const BiasRowInputs& inputs) {
            return softening_at(inputs, biases);
        });
    }

    [[nodiscard]] Softening find_softening_at_zero(float slope) override
    {
        const std::array<float, 1> none{0.0F};
        return softening_with(slope, causes().critical_biases(slope), none).front();
    }

    [[nodiscard]] CauseSums causes_at(const SlopeCurve& curve, float bias) override
    {
        const std::array<float, 1> biases{bias};
        return causes().count_at(
            curve.critical_bias, curve.slope, biases, [&](const BiasRowInputs& inputs) {
                const BiasRow row =
                    count_rows(inputs, curve.curve, amounts(curve, biases), biases).front();
                return CauseSums{row.causes, row.amounts};
            });
    }
};

/// Measures with GL's own lookups, and compares them with the curve if there is one.
class RerunMeasures final : public BiasMeasures {
public:
    explicit RerunMeasures(LookupCauses& causes) : BiasMeasures{causes} {}

    [[nodiscard]] bool reruns() const override { return true; }

    [[nodiscard]] std::vector<ErrorAmounts> amounts(MeasuredSlope slope,
                                                    std::span<const float> biases) override
    {
        std::vector<ErrorAmounts> amounts;
        for (const float bias : biases) {
            amounts.push_back(metrics_of(look_up(slope, bias)).amounts);
        }
        return amounts;
    }

    [[nodiscard]] std::vector<MeasuredBias> measure(MeasuredSlope slope,
                                                    std::span<const float> biases) override
    {
        std::vector<MeasuredBias> measured;
        for (const float bias : biases) {
            const scene::LookupLayers own = look_up(slope, bias);
            const CauseAmounts amounts = causes().causes_of(own, bias, slope.slope).amounts;
            measured.push_back({bias,
                                metrics_of(own),
                                {amounts.shadow_softening, amounts.light_softening},
                                softening_at_zero(slope.slope)});
        }
        return measured;
    }

    [[nodiscard]] std::vector<ConfigurationResult> rows(const SlopeCurve& curve,
                                                        std::span<const float> biases) override
    {
        std::vector<ConfigurationResult> rows;
        for (const float bias : biases) {
            const scene::LookupLayers own = look_up(curve, bias);
            ExplainedVerdicts found = causes().explain(own, bias, curve.slope);
            const auto by_map = errors_by_map({causes().truth(), own, causes().lookup().layers.maps,
                                               causes().lookup().view.maps.size(), found.causes,
                                               causes().traits().equal_taps()});
            rows.push_back({metrics_of(own), found.causes.counts, found.causes.amounts,
                            found.peter_panning, std::move(found.cells), maps_at(bias, by_map)});
        }
        return rows;
    }

    [[nodiscard]] std::vector<std::vector<ErrorBin>>
    profiles(const SlopeCurve& curve, std::span<const float> biases) override
    {
        std::vector<std::vector<ErrorBin>> profiles;
        for (const float bias : biases) {
            const scene::LookupLayers own = look_up(curve, bias);
            profiles.push_back(
                errors_by_bin(causes().exact().distances(),
                              {causes().truth(), own, curve.critical_bias, causes().map_error_m(),
                               causes().traits().equal_taps()}));
        }
        return profiles;
    }

    [[nodiscard]] std::optional<BiasVerification> contradictions() const override
    {
        return contradictions_;
    }

private:
    [[nodiscard]] scene::LookupLayers look_up(MeasuredSlope slope, float bias)
    {
        scene::LookupLayers own = causes().lookup().reruns->look_up(bias, slope.slope);
        if (slope.curve != nullptr) {
            const BiasVerification::Rerun held =
                compare_with_curve(own, causes().exact().receivers().receivers().triangle,
                                   slope.curve->critical_bias, bias);
            if (held.differences > 0) {
                add_reruns(contradictions_, {{held}});
            }
        }
        return own;
    }

    [[nodiscard]] Metrics metrics_of(const scene::LookupLayers& own) const
    {
        return analysis::measure(causes().truth(), own, causes().traits().equal_taps());
    }

    [[nodiscard]] Softening find_softening_at_zero(float slope) override
    {
        const CauseAmounts amounts = causes().causes_of(look_up(slope, 0), 0, slope).amounts;
        return {amounts.shadow_softening, amounts.light_softening};
    }

    [[nodiscard]] CauseSums causes_at(const SlopeCurve& curve, float bias) override
    {
        const CauseLayers found = causes().causes_of(look_up(curve.slope, bias), bias, curve.slope);
        return {found.counts, found.amounts};
    }

    std::optional<BiasVerification> contradictions_; ///< reruns that differ from the curve
};

} // namespace

std::unique_ptr<BiasMeasures> make_measures(LookupCauses& causes)
{
    if (causes.lookup().reruns) {
        return std::make_unique<RerunMeasures>(causes);
    }
    return std::make_unique<FormulaMeasures>(causes);
}

} // namespace gnomon::analysis
