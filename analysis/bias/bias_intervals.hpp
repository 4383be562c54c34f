#pragma once

#include "analysis/lookup/bias_order.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

namespace gnomon::analysis {

/// Wrong pixels of one verdict image.
struct ErrorCounts {
    std::uint64_t false_shadow = 0; ///< truth lit, verdict shadowed
    std::uint64_t false_lit = 0;    ///< truth blocked, verdict lit

    [[nodiscard]] std::uint64_t total() const { return false_shadow + false_lit; }
    friend bool operator==(const ErrorCounts&, const ErrorCounts&) = default;
};

/// Biases lo <= b <= hi. An infinite end means that there is no limit on that side.
struct BiasInterval {
    float lo = 0;
    float hi = 0;

    /// hi − lo, infinite where an end is.
    [[nodiscard]] double width() const { return double{hi} - double{lo}; }
    /// The bias nearest the middle: of a finite interval the rounded mean of its ends, of a
    /// half-infinite one its end, of an infinite one 0.
    [[nodiscard]] float middle() const;
    friend bool operator==(const BiasInterval&, const BiasInterval&) = default;
};

/// Calls `visit(interval, errors)` for every interval of biases with the same counts, in ascending
/// order, from −∞ to +∞.
/// @param lit, blocked  Critical biases of scored pixels, ascending.
template <typename Visit>
void for_each_interval(std::span<const float> lit, std::span<const float> blocked,
                       const Visit& visit)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    auto next_lit = std::upper_bound(lit.begin(), lit.end(), -infinity);
    auto next_blocked = std::upper_bound(blocked.begin(), blocked.end(), -infinity);
    const auto errors = [&] {
        return ErrorCounts{static_cast<std::uint64_t>(lit.end() - next_lit),
                           static_cast<std::uint64_t>(next_blocked - blocked.begin())};
    };
    float lo = -infinity;
    while (true) {
        const float next = std::min(next_lit != lit.end() ? *next_lit : infinity,
                                    next_blocked != blocked.end() ? *next_blocked : infinity);
        if (next == infinity) {
            visit(BiasInterval{lo, infinity}, errors());
            return;
        }
        visit(BiasInterval{lo, previous_bias(next)}, errors());
        while (next_lit != lit.end() && *next_lit == next) {
            ++next_lit;
        }
        while (next_blocked != blocked.end() && *next_blocked == next) {
            ++next_blocked;
        }
        lo = next;
    }
}

} // namespace gnomon::analysis
