#pragma once

#include "methods/job_method.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// What a setting costs.
struct LookupCost {
    std::uint64_t map_bytes = 0; ///< memory of the map
    int taps = 1;                ///< texels that make a verdict; what GL reads in one call counts

    friend auto operator<=>(const LookupCost&, const LookupCost&) = default;
};

/// What the job's map and lookups cost.
[[nodiscard]] inline LookupCost lookup_cost(const scene::Job& job)
{
    const methods::LookupTraits traits = methods::traits(job);
    return {traits.map_bytes, static_cast<int>(traits.tap_count())};
}

} // namespace gnomon::analysis
