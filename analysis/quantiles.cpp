#include "analysis/quantiles.hpp"

#include "analysis/radix_sort.hpp"

#include <cmath>

namespace gnomon::analysis {

std::optional<Quantiles> find_quantiles(std::vector<float> values)
{
    std::erase_if(values, [](float value) { return !std::isfinite(value); });
    if (values.empty()) {
        return std::nullopt;
    }
    radix_sort(values);
    const std::size_t count = values.size();
    const auto at_percent = [&](std::size_t percent) {
        return values[quantile_rank(count, percent) - 1];
    };
    return Quantiles{count, values.front(), at_percent(50), at_percent(95), values.back()};
}

} // namespace gnomon::analysis
