#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "scene/settings/job.hpp"

#include <optional>
#include <string>

namespace gnomon::analysis {

/// A constant bias as a job file has it.
struct PastedBias {
    std::string key; ///< "bias.constant = 0.0075", or of constant_m where the job has metres
    float bias = 0;  ///< what it amounts to, depth units
    std::optional<double> constant_m = {}; ///< where the key is in metres
};

/// The bias near `middle` with the fewest digits, two or more, that lies in the run.
/// @param middle    In the run; depth units, at least 0.
/// @param settings  The job's own: in metres where they are.
[[nodiscard]] PastedBias pasted_bias(float middle, const BiasInterval& run,
                                     const scene::BiasSettings& settings,
                                     const scene::LightFrustum& frustum);

} // namespace gnomon::analysis
