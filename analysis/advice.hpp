#pragma once

#include "analysis/comparison.hpp"
#include "analysis/renderers.hpp"

#include <vector>

namespace gnomon::analysis {

/// Runs GL again with the changes that suit the errors' causes, each by itself; where another
/// constant bias suits the changed map better, also with that one.
///
/// The truth is that of `comparison`. Nothing is predicted: every number was measured.
/// @param comparison  of the job; with a diagnosis.
/// @throws std::invalid_argument  if it has none.
[[nodiscard]] std::vector<Advice> advise(const Comparison& comparison, const scene::SceneFile& file,
                                         const Renderers& renderers);

} // namespace gnomon::analysis
