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
    // Rank ⌈p·count⌉, counted from 1, in integers: a product of doubles may round up across it.
    const auto at_percent = [&](std::size_t percent) {
        return values[(count * percent + 99) / 100 - 1];
    };
    return Quantiles{count, values.front(), at_percent(50), at_percent(95), values.back()};
}

} // namespace gnomon::analysis
