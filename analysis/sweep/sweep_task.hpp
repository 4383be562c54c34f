#pragma once

#include "analysis/renderers.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A scene that both renderers have loaded.
struct OpenScene {
    const scene::SceneFile* file = nullptr;
    const Renderers* renderers = nullptr;
};

/// A curve's job, and the constant biases asked of it.
struct SweepTask {
    struct Row {
        std::uint64_t ordinal = 0;
        scene::BiasSettings bias;
    };
    std::string id;
    scene::Job job; ///< without a bias axis: its constant bias is the job's own
    std::vector<Row> rows;
};

} // namespace gnomon::analysis
