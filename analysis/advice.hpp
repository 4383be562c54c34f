#pragma once

#include "analysis/bias_curve.hpp"
#include "analysis/comparison.hpp"
#include "analysis/renderers.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// One change of the job's settings, and what a run with it measured.
struct Advice {
    std::vector<std::string>
        keys; ///< what changes, as the job file writes it: "bias.constant = 0.002"
    ErrorCounts errors;
    std::optional<double> error_rate; ///< empty: no scored pixel
};

/// Runs GL again with the changes that suit the errors' causes, each by itself; where another
/// constant bias suits the changed map better, also with that one.
///
/// The truth is that of `comparison`. Nothing is predicted: every number was measured.
/// @param comparison  of the job; with a diagnosis.
/// @throws std::invalid_argument  if it has none.
[[nodiscard]] std::vector<Advice> advise(const Comparison& comparison, const scene::SceneFile& file,
                                         const Renderers& renderers);

} // namespace gnomon::analysis
