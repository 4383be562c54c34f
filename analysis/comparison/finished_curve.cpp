#include "analysis/comparison/finished_curve.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

namespace gnomon::analysis {

ConfigurationResult result_of(const Comparison& comparison)
{
    ConfigurationResult result{comparison.metrics, std::nullopt, {}, {}};
    if (comparison.diagnosis) {
        result.causes = comparison.diagnosis->causes.counts;
        result.amounts = comparison.diagnosis->causes.amounts;
        result.peter_panning = comparison.diagnosis->peter_panning;
        result.cells = comparison.diagnosis->cells;
        result.by_map =
            results_of_maps(comparison.job, comparison.view, comparison.diagnosis->by_map);
    }
    return result;
}

std::vector<ConfigurationResult> results_of(std::span<const Comparison> comparisons)
{
    std::vector<ConfigurationResult> results;
    for (const Comparison& comparison : comparisons) {
        results.push_back(result_of(comparison));
    }
    return results;
}

FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                              std::uint64_t ordinal)
{
    if (!comparison.evaluation && !comparison.diagnosis) {
        throw std::invalid_argument("finish_compared: comparison: it has no diagnosis");
    }
    FinishedCurve finished;
    if (comparison.diagnosis) {
        finished.curve = comparison.diagnosis->curve;
    }
    finished.curve.id = std::move(curve);
    finished.rows.push_back({ordinal, result_of(comparison)});
    return finished;
}

} // namespace gnomon::analysis
