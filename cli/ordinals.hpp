#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace gnomon::cli {

/// Of ascending numbers those that are not among others, ascending too.
[[nodiscard]] inline std::vector<std::uint64_t> without(const std::vector<std::uint64_t>& all,
                                                        const std::vector<std::uint64_t>& others)
{
    std::vector<std::uint64_t> rest;
    std::set_difference(all.begin(), all.end(), others.begin(), others.end(),
                        std::back_inserter(rest));
    return rest;
}

/// Numbers as a sorted list, to be asked for.
class Ordinals {
public:
    explicit Ordinals(std::vector<std::uint64_t> ascending) : ascending_{std::move(ascending)} {}

    [[nodiscard]] std::vector<std::uint64_t>
    common(const std::vector<std::uint64_t>& ordinals) const
    {
        std::vector<std::uint64_t> common;
        std::set_intersection(ascending_.begin(), ascending_.end(), ordinals.begin(),
                              ordinals.end(), std::back_inserter(common));
        return common;
    }

private:
    std::vector<std::uint64_t> ascending_;
};

} // namespace gnomon::cli
