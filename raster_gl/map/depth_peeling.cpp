#include "raster_gl/map/depth_peeling.hpp"

#include "raster_gl/scene_programs.hpp"

#include <fmt/format.h>

namespace gnomon::raster_gl {
namespace {

constexpr GLenum layer_format = GL_DEPTH_COMPONENT32F;

/// Copies both textures into the layers of an array.
Texture layered(const Texture& first, const Texture& second, int side_texels)
{
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    Texture array{name};
    glTextureStorage3D(name, 1, layer_format, side_texels, side_texels, 2);
    GLint layer = 0;
    for (const Texture* const texture : {&first, &second}) {
        glCopyImageSubData(texture->name(), GL_TEXTURE_2D, 0, 0, 0, 0, name, GL_TEXTURE_2D_ARRAY, 0,
                           0, 0, layer++, side_texels, side_texels, 1);
    }
    return array;
}

} // namespace

DepthPeeling::DepthPeeling(const Context& context)
    : context_{context},
      behind_{make_peeling_program()},
      target_{make_framebuffer()}
{
    glNamedFramebufferDrawBuffer(target_.name(), GL_NONE);
    context.check("compiling the depth-peeling program");
}

void DepthPeeling::draw(const GpuScene& scene, const Texture* front, const Texture& target,
                        bool reversed, int side_texels)
{
    set_uniform(behind_, "peels", front == nullptr ? 0U : 1U);
    glBindTextureUnit(0, front == nullptr ? 0 : front->name());
    glNamedFramebufferTexture(target_.name(), GL_DEPTH_ATTACHMENT, target.name(), 0);
    const float far_depth = reversed ? 0.0F : 1.0F;
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &far_depth);
    draw_casters(scene, behind_, side_texels);
}

std::span<const Texture> DepthPeeling::render(const GpuScene& scene,
                                              std::span<const scene::LightFrustum> maps,
                                              const scene::ShadowMapSettings& settings)
{
    forget();
    const int side = settings.resolution_texels;
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    prepare_to_draw_casters(maps.front(), settings);
    glBindSampler(0, 0);
    glUseProgram(behind_.name());
    for (const scene::LightFrustum& map : maps) {
        set_uniform(behind_, "clip_from_world", map.light_clip_from_world);
        set_uniform(behind_, "reversed", map.reversed ? 1U : 0U);
        const Texture first = make_texture(layer_format, side, side);
        const Texture second = make_texture(layer_format, side, side);
        draw(scene, nullptr, first, map.reversed, side);
        draw(scene, &first, second, map.reversed, side);
        layers_.push_back(layered(first, second, side));
    }
    glFinish();
    context_.check(fmt::format("depth peeling a map of {0}×{0} texels", side));
    return layers_;
}

void DepthPeeling::forget()
{
    target_ = make_framebuffer(); // a framebuffer keeps its attachments alive
    glNamedFramebufferDrawBuffer(target_.name(), GL_NONE);
    layers_.clear();
}

} // namespace gnomon::raster_gl
