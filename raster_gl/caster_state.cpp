#include "raster_gl/caster_state.hpp"

#include <epoxy/gl.h>

#include <cstdint>
#include <string_view>

namespace gnomon::raster_gl {
namespace {

void set_culling(scene::Cull cull)
{
    if (cull == scene::Cull::none) {
        glDisable(GL_CULL_FACE);
        return;
    }
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glCullFace(cull == scene::Cull::front ? GL_FRONT : GL_BACK);
}

} // namespace

Program make_caster_program(const CasterOutput& output)
{
    const bool has_distances = output.content == scene::MapContent::distance;
    const std::string_view fragment =
        has_distances || output.is_unorm ? "shadow_map_written.frag" : std::string_view{};
    return make_program(
        {"shadow_map.vert",
         fragment,
         {{"DISTANCE", has_distances ? "1" : "0"}, {"UNORM", output.is_unorm ? "1" : "0"}},
         nullptr});
}

void prepare_to_draw_casters(const scene::LightFrustum& map,
                             const scene::ShadowMapSettings& settings)
{
    glViewport(0, 0, settings.resolution_texels, settings.resolution_texels);
    glClipControl(GL_LOWER_LEFT, map.clip_range == scene::ClipRange::zero_to_one
                                     ? GL_ZERO_TO_ONE
                                     : GL_NEGATIVE_ONE_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(map.reversed ? GL_GREATER : GL_LESS);
    set_culling(settings.cull);
}

bool is_large_map(int resolution_texels, int samples)
{
    constexpr std::int64_t largest = std::int64_t{4096} * 4096;
    return std::int64_t{resolution_texels} * resolution_texels * samples > largest;
}

void draw_casters(const GpuScene& scene, int resolution_texels, int samples)
{
    if (is_large_map(resolution_texels, samples)) {
        scene.draw_casters_in_parts();
    } else {
        scene.draw_casters();
    }
}

} // namespace gnomon::raster_gl
