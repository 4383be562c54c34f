#include "analysis/lookup/lookup_rule.hpp"

#include "methods/job_method.hpp"

#include <algorithm>

namespace gnomon::analysis {

using scene::infinity;
using scene::Outside;

float LookupRule::outside_depth() const
{
    if (traits.interpolates()) {
        return (outside == Outside::shadowed) != reversed ? 0.0F : 1.0F;
    }
    return (outside == Outside::lit) != reversed ? infinity : -infinity;
}

bool LookupRule::is_beyond_far(float r) const
{
    if (outside == Outside::clamp) {
        return reversed ? r <= 0 : r >= 1;
    }
    return reversed ? !(r >= 0) : !(r <= 1);
}

bool LookupRule::border_decides(float r, std::span<const Tap> taps) const
{
    return outside != Outside::clamp &&
           (is_beyond_far(r) || std::ranges::none_of(taps, &Tap::is_inside));
}

LookupRule lookup_rule(const scene::Job& job, const scene::View& view)
{
    return {methods::traits(job),
            job.lookup.outside,
            view.first_map().reversed,
            view.bias.slope,
            view.map_choice == scene::MapChoice::cube_face,
            view.bias_scales};
}

} // namespace gnomon::analysis
