#include "raster_gl/map/multisampled_depth.hpp"

#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/scene_programs.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace gnomon::raster_gl {
namespace {

using Kind = scene::DepthFormat::Kind;

/// Scope in which a fragment shader that writes depths runs once per sample.
class SampleShadingScope {
public:
    SampleShadingScope()
    {
        glEnable(GL_SAMPLE_SHADING);
        glMinSampleShading(1.0F);
    }
    SampleShadingScope(const SampleShadingScope&) = delete;
    SampleShadingScope& operator=(const SampleShadingScope&) = delete;
    ~SampleShadingScope() { glDisable(GL_SAMPLE_SHADING); }
};

} // namespace

MultisampledDepth::MultisampledDepth(const Context& context)
    : context_{context},
      depth_only_{make_caster_program({})},
      unorm_{make_caster_program({.converted = Kind::unorm})},
      target_{make_framebuffer()}
{
    glNamedFramebufferDrawBuffer(target_.name(), GL_NONE);
    context.check("compiling the programs of multisampled shadow maps");
}

void MultisampledDepth::require_samples(int samples) const
{
    const int largest = context_.facts().max_depth_samples;
    if (samples > largest) {
        throw scene::InputError(
            fmt::format("method.samples = {}: this driver supports at most {} per texel; lower it",
                        samples, largest));
    }
}

Texture MultisampledDepth::make_depths(const scene::ShadowMapSettings& settings, int samples) const
{
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &name);
    Texture texture{name};
    glTextureStorage2DMultisample(name, samples, internal_format(settings.depth_format),
                                  settings.resolution_texels, settings.resolution_texels, GL_TRUE);
    context_.check(fmt::format("allocating a {0}×{0} shadow map of {1} samples",
                               settings.resolution_texels, samples));
    require_format(texture, settings.depth_format);
    GLint given = 0;
    glGetTextureLevelParameteriv(name, 0, GL_TEXTURE_SAMPLES, &given);
    if (given != samples) {
        throw scene::InputError(
            fmt::format("method.samples = {}: this driver stores {} instead; choose another number",
                        samples, given));
    }
    return texture;
}

std::span<const Texture>
MultisampledDepth::render(const GpuScene& scene, std::span<const scene::LightFrustum> maps,
                          const scene::ShadowMapSettings& settings, int samples,
                          const std::optional<methods::PolygonOffset>& offset)
{
    if (traits_of(settings.depth_format).is_colour) {
        throw std::invalid_argument(
            "MultisampledDepth::render: settings: colour formats cannot be multisampled");
    }
    require_samples(samples);
    forget();
    const bool is_unorm = settings.depth_format.kind == Kind::unorm;
    const Program& program = is_unorm ? unorm_ : depth_only_;
    if (is_unorm) {
        set_uniform(program, "largest_code", scene::code_of_one(settings.depth_format));
    }
    const SampleShadingScope shading;
    const PolygonOffsetScope offset_scope{offset};
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    prepare_to_draw_casters(maps.front(), settings);
    glUseProgram(program.name());
    for (const scene::LightFrustum& map : maps) {
        const Texture& depths = depths_.emplace_back(make_depths(settings, samples));
        glNamedFramebufferTexture(target_.name(), GL_DEPTH_ATTACHMENT, depths.name(), 0);
        const float far_depth = map.reversed ? 0.0F : 1.0F;
        glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &far_depth);
        set_uniform(program, "clip_from_world", map.light_clip_from_world);
        draw_casters(scene, program, settings.resolution_texels, samples);
    }
    glFinish();
    context_.check("rendering a multisampled shadow map");
    return depths_;
}

void MultisampledDepth::forget()
{
    target_ = make_framebuffer(); // a framebuffer keeps its attachments alive
    glNamedFramebufferDrawBuffer(target_.name(), GL_NONE);
    depths_.clear();
}

std::vector<scene::Vec2d> MultisampledDepth::places(int samples)
{
    require_samples(samples);
    scene::ShadowMapSettings smallest;
    smallest.resolution_texels = 1;
    const Texture depths = make_depths(smallest, samples);
    glNamedFramebufferTexture(target_.name(), GL_DEPTH_ATTACHMENT, depths.name(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    std::vector<scene::Vec2d> places;
    for (int i = 0; i < samples; ++i) {
        std::array<GLfloat, 2> place{};
        glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), place.data());
        places.emplace_back(place[0], place[1]);
    }
    glNamedFramebufferTexture(target_.name(), GL_DEPTH_ATTACHMENT, 0, 0);
    context_.check("querying the sample positions");
    return places;
}

} // namespace gnomon::raster_gl
