#include "raster_gl/lookup.hpp"

#include "methods/depth/filters.hpp"
#include "methods/glsl.hpp"
#include "raster_gl/readback.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <stdexcept>

namespace gnomon::raster_gl {
namespace {

using methods::Sampling;
using scene::Outside;

/// What comes before the shadow test itself: what a lookup may read, and the filter's piece.
std::string lookup_pieces(const methods::FilterPromises& promised)
{
    // A driver's log then counts each piece's lines: 1 the map's, 2 the filter's, 0 the shader's.
    return fmt::format("#line 1 1\n{}#line 1 2\n{}#line 1 0\n", shader_source("lookup_map.glsl"),
                       methods::glsl_source(promised.glsl));
}

const char* flag(bool on)
{
    return on ? "1" : "0";
}

/// Towards a directional light, or a spot's position.
scene::Vec3f light_uniform(const scene::Light& light)
{
    return light.type == scene::LightType::spot ? scene::Vec3f{light.position}
                                                : scene::Vec3f{-glm::normalize(light.direction)};
}

/// A texel outside the map is as far as can be where it shall count as lit, else as near.
float border_depth(Outside outside, bool reversed)
{
    return (outside == Outside::shadowed) != reversed ? 0.0F : 1.0F;
}

void set_sampler(const Sampler& sampler, GLint filter, Outside outside, bool reversed)
{
    const GLint wrap = outside == Outside::clamp ? GL_CLAMP_TO_EDGE : GL_CLAMP_TO_BORDER;
    const float depth = border_depth(outside, reversed);
    const std::array<float, 4> border{depth, depth, depth, depth};
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, wrap);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, wrap);
    glSamplerParameterfv(sampler.name(), GL_TEXTURE_BORDER_COLOR, border.data());
}

} // namespace

LookupPass::LookupPass(const Context& context)
    : context_{context},
      no_attributes_{make_vertex_array()},
      map_sampler_{make_sampler()},
      compare_sampler_{make_sampler()}
{
    context.check("preparing the lookup");
}

const Program& LookupPass::program(const Variant& variant)
{
    const auto found = programs_.find(variant);
    if (found != programs_.end()) {
        return found->second;
    }
    const methods::FilterPromises& promised = methods::filter_promises(variant.filter);
    const Definitions definitions{
        {"TAPS_ACROSS", std::to_string(promised.width_texels)},
        {"INTERPOLATES", flag(promised.interpolates())},
        {"OUTSIDE_CLAMP", flag(variant.outside == Outside::clamp)},
        {"OUTSIDE_VERDICT", variant.outside == Outside::shadowed ? "0.0" : "1.0"},
        {"REVERSED", flag(variant.reversed)},
        {"SPOT", flag(variant.spot)},
        {"POSITION_OF_PIXEL", flag(variant.position == scene::LookupPosition::pixel)},
        {"BISECTS", flag(variant.bisects)},
    };
    Program made = make_program(
        {"fullscreen.vert", "lookup.frag", definitions, nullptr, lookup_pieces(promised)});
    return programs_.emplace(variant, std::move(made)).first->second;
}

void LookupPass::allocate(scene::ImageSize size)
{
    if (size_ == size) {
        return;
    }
    samples_ = make_texture(GL_RGBA32F, size.width_px, size.height_px);
    texels_ = make_texture(GL_RG32F, size.width_px, size.height_px);
    target_ = make_framebuffer();
    glNamedFramebufferTexture(target_.name(), GL_COLOR_ATTACHMENT0, samples_.name(), 0);
    glNamedFramebufferTexture(target_.name(), GL_COLOR_ATTACHMENT1, texels_.name(), 0);
    constexpr std::array<GLenum, 2> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(target_.name(), 2, outputs.data());
    context_.check(fmt::format("allocating a {}×{} lookup", size.width_px, size.height_px));
    size_ = size;
}

void LookupPass::bind_map(const ShadowMap& map, const scene::LookupSettings& settings) const
{
    const methods::FilterPromises& promised = methods::filter_promises(settings.filter);
    set_sampler(map_sampler_, promised.sampling == Sampling::interpolated ? GL_LINEAR : GL_NEAREST,
                settings.outside, map.reversed);
    set_sampler(compare_sampler_, GL_LINEAR, settings.outside, map.reversed);
    glSamplerParameteri(compare_sampler_.name(), GL_TEXTURE_COMPARE_MODE,
                        GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(compare_sampler_.name(), GL_TEXTURE_COMPARE_FUNC,
                        map.reversed ? GL_GEQUAL : GL_LEQUAL);
    glBindTextureUnit(3, map.depth.name());
    glBindSampler(3, map_sampler_.name());
    if (promised.sampling == Sampling::compared) {
        glBindTextureUnit(4, map.depth.name());
        glBindSampler(4, compare_sampler_.name());
    }
}

void LookupPass::render(const GpuScene& scene, const ReceiverBuffer& receivers,
                        const ShadowMap& map, const scene::LookupSettings& settings,
                        const scene::View& view)
{
    allocate(view.image);
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    draw(scene, receivers, map, settings, view, false);
    context_.check("looking up the shadow map");
}

scene::Image<float> LookupPass::find_critical_biases(const GpuScene& scene,
                                                     const ReceiverBuffer& receivers,
                                                     const ShadowMap& map,
                                                     const scene::LookupSettings& settings,
                                                     const scene::View& view)
{
    const scene::ImageSize size = view.image;
    const Texture criticals = make_texture(GL_R32F, size.width_px, size.height_px);
    const Framebuffer target = make_framebuffer();
    glNamedFramebufferTexture(target.name(), GL_COLOR_ATTACHMENT0, criticals.name(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    draw(scene, receivers, map, settings, view, true);
    auto found = read_texture<float>(criticals, size, GL_RED, GL_FLOAT);
    context_.check("finding critical biases");
    return found;
}

void LookupPass::draw(const GpuScene& scene, const ReceiverBuffer& receivers, const ShadowMap& map,
                      const scene::LookupSettings& settings, const scene::View& view, bool bisects)
{
    if (!(receivers.size == view.image)) {
        throw std::invalid_argument("LookupPass: receivers are not of the view's size");
    }
    const bool zero_to_one = view.frustum.clip_range == scene::ClipRange::zero_to_one;
    if (zero_to_one != view.frustum.reversed) {
        throw std::invalid_argument("LookupPass: only reversed depth looks up in [0, 1]");
    }
    const bool spot = view.light.type == scene::LightType::spot;
    const Program& lookup = program(
        {settings.filter, settings.outside, map.reversed, spot, settings.position, bisects});
    const double texel_width_m = view.frustum.texel_width_m(1.0, map.resolution_texels);
    set_uniform(lookup, "light_clip_from_world", view.frustum.light_clip_from_world);
    set_uniform(lookup, "light", light_uniform(view.light));
    set_uniform(lookup, "bias_constant", view.bias.constant);
    set_uniform(lookup, "bias_slope", view.bias.slope);
    set_uniform(lookup, "normal_offset",
                static_cast<float>(double{view.bias.normal_texels} * texel_width_m));
    set_uniform(lookup, "resolution", static_cast<float>(map.resolution_texels));

    glViewport(0, 0, view.image.width_px, view.image.height_px);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    scene.bind_normals(5);
    const std::array<GLuint, 3> inputs{receivers.triangle.name(), receivers.light_clip.name(),
                                       receivers.world_position.name()};
    glBindTextures(0, static_cast<GLsizei>(inputs.size()), inputs.data());
    bind_map(map, settings);
    glBindVertexArray(no_attributes_.name());
    glUseProgram(lookup.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindSampler(3, 0);
    glBindSampler(4, 0);
    glFinish();
}

scene::LookupLayers LookupPass::read() const
{
    scene::LookupLayers layers{
        read_texture<scene::LookupSample>(samples_, size_, GL_RGBA, GL_FLOAT),
        read_texture<scene::Vec2f>(texels_, size_, GL_RG, GL_FLOAT)};
    context_.check("reading the lookup");
    return layers;
}

} // namespace gnomon::raster_gl
