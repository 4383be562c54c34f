// How much of what the camera sees lies in shadow? GL says what is seen, rays say what is shadowed.
//
//     shadow_share [SCENE]          e.g. shadow_share columns
#include "analysis/metrics/metrics.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/receivers.hpp"
#include "reference_rt/truth.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cinttypes>
#include <cstdio>
#include <exception>

namespace {

using namespace gnomon;

scene::Truth find_truth(const scene::TriangleScene& triangles, const scene::View& view)
{
    const raster_gl::Context context;
    const raster_gl::GpuScene gpu_scene{context, triangles};
    raster_gl::ReceiverPass receiver_pass{context};
    const auto& receivers = receiver_pass.render(gpu_scene, view, triangles.bounds());
    const reference_rt::ReferenceScene reference{triangles};
    return reference_rt::compute_truth(reference, view,
                                       raster_gl::read_triangles(context, receivers),
                                       {context.facts().subpixel_bits});
}

void print_shadow_share(const char* name)
{
    const scene::BuiltinScene& builtin = scene::find_builtin_scene(name);
    const scene::ParameterValues parameters = scene::complete_parameters(builtin, {});
    const scene::TriangleScene triangles = builtin.build(parameters);
    const scene::Job job = builtin.default_job(parameters);
    const scene::Truth truth = find_truth(triangles, scene::resolve_view(job, triangles, {}));

    const scene::LookupLayers no_lookup{scene::Image<scene::LookupSample>{job.image}};
    const analysis::ClassCounts counts = analysis::measure(truth, no_lookup, 1).pixels;
    std::printf("%s: %" PRIu64 " of %" PRIu64 " pixels in the light's reach are in shadow\n", name,
                counts.of(scene::PixelClass::blocked), counts.scored());
}

} // namespace

int main(int argument_count, char** arguments)
{
    try {
        print_shadow_share(argument_count > 1 ? arguments[1] : "sphere-plane");
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shadow_share: %s\n", error.what());
        return 2;
    }
}
