#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/renderers.hpp"

#include <vector>

namespace gnomon::analysis {

/// The errors of the comparison by cause and by name.
/// @param comparison  with a diagnosis.
[[nodiscard]] NamedErrors named_errors(const Comparison& comparison);

/// The cures that are known: those that `explain_advice` measured, and that of the cause `bias`,
/// which the bias curve holds.
[[nodiscard]] std::vector<Cure> known_cures(const Comparison& comparison);

/// Runs GL again with the cure of each cause that is worth naming, applied alone, and with the
/// first of the ranked remedies, and finds what is left by cause and by name, in the job's own
/// view. Cures are the removal of a bias for `bias`, a map of 32-bit floats or the origin moved for
/// `precision`, one tap for `filter`, four times the resolution for `resolution`, and no culling
/// with a map around the whole scene for `coverage`.
///
/// A cause is to be named as the one to act on only where its cure cures (`Cure::cures`).
/// @param comparison  with a diagnosis and all of its advice.
/// Source: docs/tune.md#cause-and-cure.
void explain_advice(Comparison& comparison, const scene::SceneFile& file,
                    const Renderers& renderers);

} // namespace gnomon::analysis
