#pragma once

#include "analysis/pixels/radix_sort.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Finds places in an ascending list of biases. A table over their range, usually finer than their
/// spacing, leads to a value's place or close to it.
class BiasIndex {
public:
    /// @param ascending  Fewer than 2^32; must outlive this.
    explicit BiasIndex(std::span<const float> ascending) : biases_{ascending}
    {
        if (!biases_.empty()) {
            smallest_ = sort_key(biases_.front());
            beyond_ = sort_key(biases_.back()) + 1;
        }
        // bit_width returns an int or the argument's type, depending on the version of the
        // standard.
        const auto width = static_cast<std::uint32_t>(std::bit_width(beyond_ - smallest_));
        shift_ = width > cell_bits ? width - cell_bits : 0;
        starts_.resize(cell_of(scene::infinity) + 2);
        for (const float bias : biases_) {
            ++starts_[cell_of(bias) + 1];
        }
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    }

    /// Index of the first bias that is at least `value`; the number of biases if none is.
    /// @param value  Not NaN.
    [[nodiscard]] std::size_t first_from(float value) const
    {
        const std::size_t cell = cell_of(value);
        const auto place = [&](std::size_t i) { return biases_.begin() + starts_[i]; };
        return static_cast<std::size_t>(std::lower_bound(place(cell), place(cell + 1), value) -
                                        biases_.begin());
    }

private:
    static constexpr std::uint32_t cell_bits = 16;

    /// Values below all biases fall into the first cell, values above all into the last.
    [[nodiscard]] std::size_t cell_of(float value) const
    {
        return (std::clamp(sort_key(value), smallest_, beyond_) - smallest_) >> shift_;
    }

    std::span<const float> biases_;
    std::uint32_t smallest_ = 0; ///< sort key of the first bias
    std::uint32_t beyond_ = 0;   ///< one more than the sort key of the last bias
    std::uint32_t shift_ = 0;
    std::vector<std::uint32_t> starts_; ///< first bias of each cell; ends with the list's size
};

} // namespace gnomon::analysis
