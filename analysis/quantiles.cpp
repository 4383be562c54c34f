#include "analysis/quantiles.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

std::optional<Quantiles> find_quantiles(std::span<float> values)
{
    const auto end = std::partition(values.begin(), values.end(),
                                    [](float value) { return std::isfinite(value); });
    const auto finite = values.first(static_cast<std::size_t>(end - values.begin()));
    if (finite.empty()) {
        return std::nullopt;
    }
    const std::size_t count = finite.size();
    const auto p95 = finite.begin() + static_cast<std::ptrdiff_t>(quantile_rank(count, 95) - 1);
    const auto median = finite.begin() + static_cast<std::ptrdiff_t>(quantile_rank(count, 50) - 1);
    std::nth_element(finite.begin(), p95, finite.end());
    const float max = *std::max_element(p95, finite.end());
    std::nth_element(finite.begin(), median, p95 + 1);
    const float min = *std::min_element(finite.begin(), median + 1);
    // Which of two equal zeros stands at a rank is chance: −0 becomes 0.
    return Quantiles{count, min + 0.0F, *median + 0.0F, *p95 + 0.0F, max + 0.0F};
}

std::optional<Quantiles> find_quantiles(std::vector<float>&& values)
{
    return find_quantiles(std::span{values});
}

} // namespace gnomon::analysis
