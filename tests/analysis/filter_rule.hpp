#pragma once

#include "analysis/lookup/lookup_rule.hpp"
#include "methods/depth/filters.hpp"

namespace gnomon::analysis {

/// The rule of lookups with a filter in a map of depths.
inline LookupRule rule_of(scene::Filter filter, scene::Outside outside = scene::Outside::lit,
                          bool reversed = false, float slope = 0)
{
    return {methods::filter_traits(filter), outside, reversed, slope};
}

/// What a lookup with that filter reads.
inline Footprint footprint_of(scene::Filter filter, scene::Outside outside, int resolution_texels)
{
    return {methods::filter_traits(filter), map_edge(outside, false), resolution_texels};
}

} // namespace gnomon::analysis
