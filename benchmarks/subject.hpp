#pragma once

#include "analysis/renderers.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/rasterizer.hpp"
#include "reference_rt/reference.hpp"
#include "reference_rt/truth.hpp"
#include "scene/load/load_scene.hpp"
#include "seconds_of.hpp"

#include <memory>

namespace gnomon::benchmarks {

/// A scene that both renderers have loaded, and how long that took.
struct Subject {
    explicit Subject(const scene::Job& job_in, const reference_rt::TruthOptions& options = {});
    [[nodiscard]] analysis::Renderers renderers() const { return {*gl, *truth, {}}; }

    scene::Job job;
    scene::SceneFile file;
    raster_gl::Context context;
    std::unique_ptr<raster_gl::GlRasterizer> gl;
    std::unique_ptr<reference_rt::ReferenceScene> reference; ///< for exact truth and plain rays
    std::unique_ptr<reference_rt::EmbreeReference> truth;
    double scene_s = 0;
    double upload_s = 0;
    double bvh_s = 0;
};

} // namespace gnomon::benchmarks
