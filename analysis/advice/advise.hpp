#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/comparison/remedy.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "analysis/renderers.hpp"

namespace gnomon::analysis {

/// The errors of a view.
[[nodiscard]] Outcome outcome_of(const ViewOutcome& view);

/// Reruns GL with the changes that suit the causes of the errors. Applies each change alone, with
/// the constant bias recommended for it over all views. Fills in the comparison's advice. With
/// several views, also replaces its recommendation by one that holds for all of them.
///
/// Predicts nothing: every number is measured.
/// @param comparison  Of the job, with a diagnosis.
/// @param views       The job's own first.
/// @throws std::invalid_argument  without a diagnosis.
void advise(Comparison& comparison, const CheckedViews& views, const scene::SceneFile& file,
            const Renderers& renderers);

} // namespace gnomon::analysis
