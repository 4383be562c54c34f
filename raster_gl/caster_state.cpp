#include "raster_gl/caster_state.hpp"

#include "scene/error.hpp"

#include <epoxy/gl.h>

#include <cstdint>

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

OffsetDraws::OffsetDraws(const std::optional<methods::PolygonOffset>& offset)
    : is_on_{offset.has_value()}
{
    if (!is_on_) {
        return;
    }
    if (offset->clamp == 0) {
        glPolygonOffset(offset->factor, offset->units);
    } else if (epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_polygon_offset_clamp")) {
        glPolygonOffsetClamp(offset->factor, offset->units, offset->clamp);
    } else if (epoxy_has_gl_extension("GL_EXT_polygon_offset_clamp")) {
        glPolygonOffsetClampEXT(offset->factor, offset->units, offset->clamp);
    } else {
        throw scene::InputError("bias.polygon_offset_clamp: this driver has neither "
                                "GL_ARB_polygon_offset_clamp nor the EXT one; remove the key");
    }
    glEnable(GL_POLYGON_OFFSET_FILL);
}

OffsetDraws::~OffsetDraws()
{
    if (is_on_) {
        glPolygonOffset(0, 0);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }
}

bool is_large_map(int resolution_texels, int samples)
{
    constexpr std::int64_t largest = std::int64_t{4096} * 4096;
    return std::int64_t{resolution_texels} * resolution_texels * samples > largest;
}

void draw_casters(const GpuScene& scene, const Program& program, int resolution_texels, int samples)
{
    if (is_large_map(resolution_texels, samples)) {
        scene.draw_casters_in_parts(program);
    } else {
        scene.draw_casters(program);
    }
}

} // namespace gnomon::raster_gl
