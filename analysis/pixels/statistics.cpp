#include "analysis/pixels/statistics.hpp"

#include "analysis/pixels/radix_sort.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace gnomon::analysis {

namespace {

/// Finds values by rank. Counts the values by the leading bits of their distance from the smallest,
/// which leaves few candidates for each rank.
class Ranks {
public:
    /// @param values  Finite; at least one.
    explicit Ranks(std::span<const float> values) : values_{values}
    {
        std::uint32_t largest = 0;
        for (const float value : values) {
            smallest_ = std::min(smallest_, sort_key(value));
            largest = std::max(largest, sort_key(value));
        }
        shift_ = std::max(static_cast<int>(std::bit_width(largest - smallest_)) - cell_bits, 0);
        for (const float value : values) {
            ++counts_[cell_of(value)];
        }
        min = value_of_key(smallest_);
        max = value_of_key(largest);
    }

    float min = 0;
    float max = 0;

    /// The values at two ranks, in one pass.
    /// @param ranks  Starting at 1.
    [[nodiscard]] std::array<float, 2> at(const std::array<std::size_t, 2>& ranks) const
    {
        std::array<Cell, 2> cells{cell_at(ranks[0]), cell_at(ranks[1])};
        for (const float value : values_) {
            const std::size_t cell = cell_of(value);
            for (Cell& asked : cells) {
                asked.candidates[asked.filled] = value;
                asked.filled += cell == asked.cell ? 1 : 0;
            }
        }
        return {nth(cells[0]), nth(cells[1])};
    }

private:
    static constexpr int cell_bits = 12;

    /// The cell that contains a rank.
    struct Cell {
        std::size_t cell = 0;
        std::size_t rank = 0;          ///< within the cell, from 0
        std::vector<float> candidates; ///< the cell's values, with room for one more
        std::size_t filled = 0;
    };

    [[nodiscard]] Cell cell_at(std::size_t rank) const
    {
        std::size_t cell = 0;
        std::size_t before = 0;
        while (before + counts_[cell] < rank) {
            before += counts_[cell++];
        }
        return {cell, rank - before - 1, std::vector<float>(counts_[cell] + std::size_t{1}), 0};
    }
    [[nodiscard]] static float nth(Cell& cell)
    {
        const auto begin = cell.candidates.begin();
        const auto nth = begin + static_cast<std::ptrdiff_t>(cell.rank);
        std::nth_element(begin, nth, begin + static_cast<std::ptrdiff_t>(cell.filled));
        return *nth;
    }

    [[nodiscard]] std::size_t cell_of(float value) const
    {
        return (sort_key(value) - smallest_) >> static_cast<unsigned>(shift_);
    }

    std::span<const float> values_;
    std::uint32_t smallest_ = std::numeric_limits<std::uint32_t>::max();
    int shift_ = 0;
    std::array<std::uint32_t, std::size_t{1} << cell_bits> counts_{};
};

} // namespace

std::optional<Quantiles> find_quantiles(std::span<float> values)
{
    const auto end = std::partition(values.begin(), values.end(),
                                    [](float value) { return std::isfinite(value); });
    const auto finite = values.first(static_cast<std::size_t>(end - values.begin()));
    if (finite.empty()) {
        return std::nullopt;
    }
    const Ranks ranks{finite};
    const std::size_t count = finite.size();
    // Either zero may stand at a rank: −0 becomes 0.
    const auto [median, p95] = ranks.at({quantile_rank(count, 50), quantile_rank(count, 95)});
    return Quantiles{count, ranks.min + 0.0F, median + 0.0F, p95 + 0.0F, ranks.max + 0.0F};
}

std::optional<Quantiles> find_quantiles(std::vector<float>&& values)
{
    return find_quantiles(std::span{values});
}

} // namespace gnomon::analysis
