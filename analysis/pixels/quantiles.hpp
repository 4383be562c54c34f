#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The spread of some values: each is one of them, the smallest that at least the named share of
/// the values does not exceed (nearest rank).
struct Quantiles {
    std::uint64_t count = 0;
    float min = 0;
    float median = 0;
    float p95 = 0;
    float max = 0;

    friend bool operator==(const Quantiles&, const Quantiles&) = default;
};

/// The rank of a percentile among `count` values, counted from 1: ⌈percent/100 · count⌉.
[[nodiscard]] constexpr std::size_t quantile_rank(std::size_t count, std::size_t percent)
{
    // In integers: a product of doubles may round up across it.
    return (count * percent + 99) / 100;
}

/// @param values  In any order; those that are not finite are left out. They are reordered.
/// @return  Empty if no value is finite.
[[nodiscard]] std::optional<Quantiles> find_quantiles(std::span<float> values);
[[nodiscard]] std::optional<Quantiles> find_quantiles(std::vector<float>&& values);

} // namespace gnomon::analysis
