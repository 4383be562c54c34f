#pragma once

#include "analysis/comparison/evaluation.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/pixels/rounded_receivers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

namespace gnomon::analysis {

/// A case in memory.
struct Case {
    const scene::CaseFile& file;
    const scene::CaseLayers& layers;
    const scene::TriangleScene& mesh; ///< in the renderer's space, with its roles
};

/// A case compared with its mesh and light, as far as it takes to know whether it can be scored.
struct CheckedCase {
    scene::Job job;
    scene::View view;
    scene::RoundedReceivers receivers;
    scene::RoundedTruth truth; ///< empty if a mistake was found first
    ImportCheck check;
};

} // namespace gnomon::analysis
