// How wide is a shadow-map texel where the camera looks? Prints the answer for a built-in scene.
//
//     texel_widths [SCENE]          e.g. texel_widths yard
#include "scene/builtin/scenes.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdio>
#include <exception>

namespace {

using namespace gnomon::scene;

void print_texel_widths(const char* name)
{
    const BuiltinScene& builtin = find_builtin_scene(name);
    const ParameterValues parameters = complete_parameters(builtin, {});
    const TriangleScene scene = builtin.build(parameters);
    const Job job = builtin.default_job(parameters);
    const LightFrustum frustum = resolve_view(job, scene, {}).first_map();

    const double light_distance_m = frustum.light_distance_m(scene.bounds().centre());
    std::printf("%s: %zu triangles, light camera from %g m to %g m\n", name, scene.triangles.size(),
                frustum.near_m, frustum.far_m);
    for (const int resolution_texels : {512, 1024, 2048, 4096}) {
        std::printf("  %4d texels: %.6f m wide at the scene's centre\n", resolution_texels,
                    frustum.texel_width_m(light_distance_m, resolution_texels));
    }
}

} // namespace

int main(int argument_count, char** arguments)
{
    try {
        print_texel_widths(argument_count > 1 ? arguments[1] : "sphere-plane");
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "texel_widths: %s\n", error.what());
        return 2;
    }
}
