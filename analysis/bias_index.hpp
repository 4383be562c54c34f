#pragma once

#include "analysis/radix_sort.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Finds places in an ascending list of biases: a table by a value's leading bits leads to its
/// neighbourhood, where few biases are left to be compared with.
class BiasIndex {
public:
    /// @param ascending  Must outlive the index; fewer than 2^32.
    explicit BiasIndex(std::span<const float> ascending) : biases_{ascending}, starts_(cells + 1)
    {
        for (const float bias : biases_) {
            ++starts_[cell_of(bias) + 1];
        }
        for (std::size_t cell = 0; cell < cells; ++cell) {
            starts_[cell + 1] += starts_[cell];
        }
    }

    /// Index of the first bias that is not below `value`; the number of biases if all are.
    /// @param value  anything but NaN.
    [[nodiscard]] std::size_t first_from(float value) const
    {
        const std::size_t cell = cell_of(value);
        const auto place = [&](std::size_t i) { return biases_.begin() + starts_[i]; };
        return static_cast<std::size_t>(std::lower_bound(place(cell), place(cell + 1), value) -
                                        biases_.begin());
    }

private:
    static constexpr std::size_t cells = std::size_t{1} << 16U; ///< sign, exponent, 7 digits

    static std::size_t cell_of(float value) { return sort_key(value) >> 16U; }

    std::span<const float> biases_;
    std::vector<std::uint32_t> starts_; ///< of each cell's biases; the last is the list's end
};

} // namespace gnomon::analysis
