#include "analysis/results/results.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

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

/// Quantiles that know only their number of pixels, because quantiles do not add up.
std::optional<Quantiles> counted(std::uint64_t pixels)
{
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    return pixels == 0 ? std::nullopt
                       : std::optional{Quantiles{pixels, unknown, unknown, unknown, unknown}};
}

} // namespace

ConfigurationResult total_of(std::span<const ConfigurationResult> results)
{
    ConfigurationResult total;
    std::uint64_t gap_pixels = 0;
    const bool has_causes = std::ranges::all_of(
        results, [](const ConfigurationResult& result) { return result.causes.has_value(); });
    if (has_causes) {
        total.causes.emplace();
    }
    for (const ConfigurationResult& result : results) {
        total.metrics += result.metrics;
        if (has_causes) {
            add(*total.causes, *result.causes);
            add(total.amounts, result.amounts);
            gap_pixels += result.peter_panning.metres ? result.peter_panning.metres->count : 0;
        }
    }
    total.peter_panning = {counted(gap_pixels), counted(gap_pixels)};
    return total;
}

} // namespace gnomon::analysis
