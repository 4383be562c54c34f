#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

namespace gnomon::api {

/// Of ascending numbers those that are not among others, ascending too.
[[nodiscard]] inline std::vector<std::uint64_t> without(const std::vector<std::uint64_t>& all,
                                                        const std::vector<std::uint64_t>& others)
{
    std::vector<std::uint64_t> rest;
    std::set_difference(all.begin(), all.end(), others.begin(), others.end(),
                        std::back_inserter(rest));
    return rest;
}

/// Ascending numbers that are in both lists, ascending too.
[[nodiscard]] inline std::vector<std::uint64_t> common(const std::vector<std::uint64_t>& some,
                                                       const std::vector<std::uint64_t>& others)
{
    std::vector<std::uint64_t> both;
    std::set_intersection(some.begin(), some.end(), others.begin(), others.end(),
                          std::back_inserter(both));
    return both;
}

} // namespace gnomon::api
