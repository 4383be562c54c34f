#pragma once

#include "analysis/evaluate/case_truth.hpp"
#include "analysis/evaluate/evaluation.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/view/view.hpp"

#include <optional>

namespace gnomon::analysis {

/// A case in memory.
struct Case {
    const scene::CaseFile& file;
    const scene::CaseLayers& layers;
    const scene::TriangleScene& mesh; ///< in the renderer's space, with its roles
};

/// A case compared with its mesh and light, as far as needed to know whether it can be scored.
struct CheckedCase {
    scene::Job job;
    scene::View view;
    scene::RoundedReceivers receivers;
    scene::RoundedTruth truth; ///< empty where a mistake was found before
    ImportCheck check;
};

/// Checks a case, and finds the truth of its pixels.
/// @param tolerance_m  of the 99th percentile of distances; empty: `default_tolerance_m`.
/// @throws scene::InputError  if the light or camera is not valid, or `objects` names no object.
[[nodiscard]] CheckedCase check_case(const Case& subject, const CaseTruth& truth,
                                     std::optional<double> tolerance_m);

} // namespace gnomon::analysis
