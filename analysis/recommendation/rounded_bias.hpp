#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "scene/settings/job.hpp"

#include <string>

namespace gnomon::analysis {

/// A constant bias as a job file has it.
struct RoundedBias {
    std::string key; ///< "bias.constant = 0.0075", or of another unit where the job has that
    float bias = 0;  ///< what it amounts to, depth units
    const scene::BiasUnit* unit = &scene::bias_in_depth;
    double value = 0; ///< what a job has in that unit; in depth units `bias`
};

/// The bias near `middle` with the fewest digits, two or more, that lies in the run.
/// @param middle    In the run; depth units, at least 0.
/// @param settings  The job's own, whose unit it has.
[[nodiscard]] RoundedBias rounded_bias(float middle, const BiasInterval& run,
                                       const scene::BiasSettings& settings,
                                       const scene::LightFrustum& frustum);

} // namespace gnomon::analysis
