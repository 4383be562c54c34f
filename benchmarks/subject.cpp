#include "subject.hpp"

namespace gnomon::benchmarks {

Subject::Subject(const scene::Job& job_in, const reference_rt::TruthOptions& options) : job{job_in}
{
    scene_s = seconds_of([&] { file = scene::load_scene(job.scene); });
    upload_s =
        seconds_of([&] { gl = std::make_unique<raster_gl::GlRasterizer>(context, file.scene); });
    bvh_s = seconds_of([&] {
        reference = std::make_unique<reference_rt::ReferenceScene>(
            file.scene, reference_rt::ReferenceOptions{.serves_plain_rays = true});
    });
    truth = std::make_unique<reference_rt::EmbreeReference>(*reference, options);
}

} // namespace gnomon::benchmarks
