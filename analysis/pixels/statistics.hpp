#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// part / whole; empty if the whole is 0.
[[nodiscard]] inline std::optional<double> ratio(double part, std::uint64_t whole)
{
    if (whole == 0) {
        return std::nullopt;
    }
    return part / static_cast<double>(whole);
}

[[nodiscard]] inline std::optional<double> ratio(std::uint64_t part, std::uint64_t whole)
{
    return ratio(static_cast<double>(part), whole);
}

/// Quantiles by nearest rank: each is the smallest value that at least this share of all values
/// does not exceed.
struct Quantiles {
    std::uint64_t count = 0;
    float min = 0;
    float median = 0;
    float p95 = 0;
    float max = 0;

    friend bool operator==(const Quantiles&, const Quantiles&) = default;
};

/// The rank of a percentile among `count` values, starting at 1: ⌈percent/100 · count⌉.
[[nodiscard]] constexpr std::size_t quantile_rank(std::size_t count, std::size_t percent)
{
    // In integers, since a product of doubles could round up past it.
    return (count * percent + 99) / 100;
}

/// @param values  In any order; reordered. Values that are not finite are ignored.
/// @return  Empty if no value is finite.
[[nodiscard]] std::optional<Quantiles> find_quantiles(std::span<float> values);
[[nodiscard]] std::optional<Quantiles> find_quantiles(std::vector<float>&& values);

} // namespace gnomon::analysis
