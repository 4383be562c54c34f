#include "analysis/metrics/totals.hpp"

#include <algorithm>
#include <functional>
#include <vector>

namespace gnomon::analysis {

namespace {

void add(CauseCounts& sum, const CauseCounts& counts)
{
    std::ranges::transform(sum.by_cause, counts.by_cause, sum.by_cause.begin(), std::plus<>{});
    std::ranges::transform(sum.by_label, counts.by_label, sum.by_label.begin(), std::plus<>{});
}

void add(CauseAmounts& sum, const CauseAmounts& amounts)
{
    std::ranges::transform(sum.by_cause, amounts.by_cause, sum.by_cause.begin(), std::plus<>{});
    std::ranges::transform(sum.by_label, amounts.by_label, sum.by_label.begin(), std::plus<>{});
    sum.shadow_softening += amounts.shadow_softening;
    sum.light_softening += amounts.light_softening;
}

} // namespace

ConfigurationResult total_of(std::span<const ConfigurationResult> results)
{
    ClassCounts pixels;
    VerdictErrors errors;
    ConfigurationResult total;
    const bool has_causes = std::ranges::all_of(
        results, [](const ConfigurationResult& result) { return result.causes.has_value(); });
    if (has_causes) {
        total.causes.emplace();
    }
    for (const ConfigurationResult& result : results) {
        pixels += result.metrics.pixels;
        errors.false_shadow += result.metrics.false_shadow;
        errors.false_lit += result.metrics.false_lit;
        errors.amounts += result.metrics.amounts;
        if (has_causes) {
            add(*total.causes, *result.causes);
            add(total.amounts, result.amounts);
        }
    }
    total.metrics = make_metrics(pixels, errors);
    return total;
}

} // namespace gnomon::analysis
