#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/bias/bias_order.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace gnomon::analysis {

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
