#include "subject.hpp"

namespace gnomon::benchmarks {

Subject::Subject(const scene::Job& job_in) : job{job_in}
{
    scene_s = seconds_of([&] { file = scene::load_scene(job.scene); });
    upload_s = seconds_of([&] { gl = std::make_unique<cli::GlRenderer>(context, file.scene); });
    bvh_s = seconds_of([&] {
        reference = std::make_unique<reference_rt::ReferenceScene>(
            file.scene, reference_rt::ReferenceOptions{.serves_plain_rays = true});
    });
}

} // namespace gnomon::benchmarks
