#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/settings/job.hpp"

#include <string>
#include <vector>

namespace gnomon::analysis {

/// A job with some keys changed.
struct Variant {
    scene::Job job;
    std::vector<std::string> keys; ///< as the job file writes them; empty: the job as it is
    bool mends_a_bias = false;     ///< `BiasChange::mends`
};

/// The comparison's job with what the causes of its errors call for, one change each; the job as
/// it is first, for another constant bias may do.
/// @param comparison  with a diagnosis.
[[nodiscard]] std::vector<Variant> variants_for(const Comparison& comparison);

} // namespace gnomon::analysis
