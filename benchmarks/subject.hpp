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

/// A scene loaded into both renderers, with the durations.
struct Subject {
    explicit Subject(const scene::Job& job_in, const reference_rt::TruthOptions& options = {})
        : job{job_in}
    {
        scene_s = seconds_of([&] { file = scene::load_scene(job.scene); });
        upload_s = seconds_of(
            [&] { gl = std::make_unique<raster_gl::GlRasterizer>(context, file.scene); });
        bvh_s = seconds_of([&] {
            reference = std::make_unique<reference_rt::ReferenceScene>(
                file.scene, reference_rt::ReferenceOptions{.serves_plain_rays = true});
        });
        truth = std::make_unique<reference_rt::EmbreeReference>(*reference, options);
    }
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
