#pragma once

#include "cli/session/renderers.hpp"
#include "raster_gl/context.hpp"
#include "reference_rt/truth.hpp"
#include "scene/load_scene.hpp"
#include "seconds_of.hpp"

#include <memory>

namespace gnomon::benchmarks {

/// A scene that both renderers have loaded, and how long that took.
struct Subject {
    explicit Subject(const scene::Job& job_in);

    scene::Job job;
    scene::SceneFile file;
    raster_gl::Context context;
    std::unique_ptr<cli::GlRenderer> gl;
    std::unique_ptr<reference_rt::ReferenceScene> reference; ///< for exact truth and plain rays
    double scene_s = 0;
    double upload_s = 0;
    double bvh_s = 0;
};

} // namespace gnomon::benchmarks
