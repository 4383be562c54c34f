#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/settings/job.hpp"

#include <string>
#include <vector>

namespace gnomon::analysis {

/// A job with some keys changed.
struct Variant {
    scene::Job job;
    std::vector<std::string> keys; ///< as the job file writes them; empty for the unchanged job
    bool mends_a_bias = false;     ///< `BiasChange::mends`
};

/// The comparison's job with the changes that the causes of its errors suggest, one each. Starts
/// with the unchanged job, since another constant bias may suffice.
/// @param comparison  With a diagnosis.
[[nodiscard]] std::vector<Variant> variants_for(const Comparison& comparison);

} // namespace gnomon::analysis
