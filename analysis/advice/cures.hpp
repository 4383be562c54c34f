#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/renderers.hpp"

#include <vector>

namespace gnomon::analysis {

/// The errors of the comparison by cause and label.
/// @param comparison  With a diagnosis.
[[nodiscard]] NamedErrors named_errors(const Comparison& comparison);

/// The known cures: those that `explain_advice` measured, and that of the cause `bias`, which comes
/// from the bias curve.
[[nodiscard]] std::vector<Cure> known_cures(const Comparison& comparison);

/// Reruns GL with the cure of each cause worth naming, applied alone, and with the best remedy.
/// Finds the remaining errors by cause and label, in the job's own view. The cures are: no bias for
/// `bias`, a float32 map or a moved origin for `precision`, one tap for `filter`, four times the
/// resolution for `resolution`, and no culling with a map around the whole scene for `coverage`.
///
/// Name a cause as the one to act on only if its cure works (`Cure::cures`).
/// @param comparison  With a diagnosis and all of its advice.
/// Source: docs/tune.md#cause-and-cure.
void explain_advice(Comparison& comparison, const scene::SceneFile& file,
                    const Renderers& renderers);

} // namespace gnomon::analysis
