#include "analysis/tap_rules.hpp"

#include <algorithm>

namespace gnomon::analysis {

using scene::Outside;

bool TapRules::is_beyond_far(float r) const
{
    if (lookup.outside == Outside::clamp) {
        return reversed ? r <= 0 : r >= 1;
    }
    return reversed ? !(r >= 0) : !(r <= 1);
}

bool TapRules::is_policy(float r, std::span<const Tap> taps) const
{
    return lookup.outside != Outside::clamp &&
           (is_beyond_far(r) || std::ranges::none_of(taps, &Tap::is_inside));
}

} // namespace gnomon::analysis
