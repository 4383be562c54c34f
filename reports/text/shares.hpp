#pragma once

#include "analysis/metrics/named_errors.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace gnomon::reports {

/// "82 %": a share as people say it.
[[nodiscard]] std::string share_of(double part, double whole);

template <std::size_t size>
[[nodiscard]] double sum_of(const std::array<double, size>& errors)
{
    return std::accumulate(errors.begin(), errors.end(), 0.0);
}

/// Those that are worth naming, the largest first.
template <std::size_t size>
[[nodiscard]] std::vector<std::size_t> largest(const std::array<double, size>& errors)
{
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < size; ++i) {
        if (analysis::is_worth_naming(errors, i)) {
            order.push_back(i);
        }
    }
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return errors.at(i); });
    return order;
}

} // namespace gnomon::reports
