#include "raster_gl/caster_state.hpp"

#include <epoxy/gl.h>

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

bool is_large_map(int resolution_texels)
{
    return resolution_texels > 4096;
}

} // namespace gnomon::raster_gl
