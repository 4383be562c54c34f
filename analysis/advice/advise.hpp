#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/comparison/remedy.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "analysis/renderers.hpp"

namespace gnomon::analysis {

/// What a view's verdicts are worth.
[[nodiscard]] Outcome outcome_of(const ViewOutcome& view);

/// Runs GL again with the changes that suit the errors' causes, each by itself and with the
/// constant bias that is recommended for it over all views; fills in the comparison's advice, and
/// where there are several views its recommendation, which then holds for them all.
///
/// Nothing is predicted: every number was measured.
/// @param comparison  of the job, with a diagnosis.
/// @param views       The job's own first.
/// @throws std::invalid_argument  if it has none.
void advise(Comparison& comparison, const CheckedViews& views, const scene::SceneFile& file,
            const Renderers& renderers);

} // namespace gnomon::analysis
