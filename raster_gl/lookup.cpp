#include "raster_gl/lookup.hpp"

#include "methods/job_method.hpp"
#include "raster_gl/glsl_snippets.hpp"
#include "raster_gl/readback.hpp"
#include "raster_gl/scene_programs.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::raster_gl {
namespace {

using methods::Sampling;
using scene::Outside;

const char* flag(bool on)
{
    return on ? "1" : "0";
}

/// Border colours for depth 0 and depth 1.
using DepthEnds = std::array<std::array<float, 4>, 2>;
constexpr DepthEnds depth_ends{{{0, 0, 0, 0}, {1, 1, 1, 1}}};

/// Texels outside the map are farthest if they count as lit, else nearest.
const std::array<float, 4>& border_of(const DepthEnds& ends, Outside outside, bool reversed)
{
    return (outside == Outside::shadowed) != reversed ? ends.front() : ends.back();
}

void set_sampler(const Sampler& sampler, GLint filter, Outside outside,
                 const std::array<float, 4>& border)
{
    const GLint wrap = outside == Outside::clamp ? GL_CLAMP_TO_EDGE : GL_CLAMP_TO_BORDER;
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, wrap);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, wrap);
    glSamplerParameterfv(sampler.name(), GL_TEXTURE_BORDER_COLOR, border.data());
}

bool is_position_of_pixel(const scene::Job& job)
{
    return scene::lookup_position(job) == scene::LookupPosition::pixel;
}

bool is_cube(const scene::View& view)
{
    return view.map_choice == scene::MapChoice::cube_face;
}

void require_maps(const ShadowMap& map, const scene::Job& job, const scene::View& view)
{
    for (const scene::LightFrustum& frustum : view.maps) {
        const bool zero_to_one = frustum.clip_range == scene::ClipRange::zero_to_one;
        if (zero_to_one != frustum.reversed || frustum.reversed != map.reversed) {
            throw std::invalid_argument("LookupPass: the clip range [0, 1] needs reversed depth");
        }
    }
    if (map.depth.layer_count() != view.maps.size()) {
        throw std::invalid_argument("LookupPass: the number of maps differs from the view's");
    }
    if (view.maps.size() > 1 && !is_position_of_pixel(job)) {
        throw std::invalid_argument("LookupPass: several maps need lookups from pixels");
    }
}

void set_anisotropy(const Sampler& sampler, int anisotropy, const Context& context)
{
    const float largest = context.facts().max_anisotropy;
    if (static_cast<float>(anisotropy) > largest) {
        throw scene::InputError(fmt::format(
            "anisotropy {}: this driver supports at most {:.3g}; lower it", anisotropy, largest));
    }
    if (largest > 1) {
        glSamplerParameterf(sampler.name(), GL_TEXTURE_MAX_ANISOTROPY,
                            static_cast<float>(anisotropy));
    }
}

bool reads_vertex_normals(std::span<const methods::ActiveBias> biases)
{
    return std::ranges::any_of(biases, [](const methods::ActiveBias& bias) {
        return std::ranges::find(bias.snippet.definitions, methods::vertex_normals_definition,
                                 &methods::Definition::name) != bias.snippet.definitions.end();
    });
}

void bind_receivers(const LookupSource& from, std::span<const methods::ActiveBias> biases)
{
    const ReceiverBuffer& receivers = from.receivers;
    from.scene.bind_normals(5);
    const std::array<GLuint, 3> inputs{receivers.triangle.name(), receivers.light_clip.name(),
                                       receivers.world_position.name()};
    glBindTextures(0, static_cast<GLsizei>(inputs.size()), inputs.data());
    if (!reads_vertex_normals(biases)) {
        return;
    }
    if (receivers.vertex_normal.empty()) {
        throw std::invalid_argument("LookupPass: the scene was loaded without vertex normals");
    }
    glBindTextureUnit(11, receivers.vertex_normal.name());
}

/// Uploads and binds depths, if given.
Texture upload_depths(const scene::Image<float>* depths, GLuint unit)
{
    if (depths == nullptr) {
        return {};
    }
    Texture texture = upload(*depths);
    glBindTextureUnit(unit, texture.name());
    return texture;
}

/// Rounds verdicts to the nearest share k/taps.
void round_to_taps(scene::Image<scene::LookupSample>& samples, int taps)
{
    const auto whole = static_cast<float>(taps);
    for (std::size_t i = 0; i < samples.pixel_count(); ++i) {
        float& verdict = samples[i].verdict;
        if (verdict > 0 && verdict < 1) {
            verdict = std::round(verdict * whole) / whole;
        }
    }
}

} // namespace

LookupPass::LookupPass(const Context& context)
    : context_{context},
      no_attributes_{make_vertex_array()},
      map_sampler_{make_sampler()},
      compare_sampler_{make_sampler()},
      filtered_sampler_{make_sampler()}
{
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    context.check("preparing the lookup");
}

Definitions LookupPass::definitions(const LookupSource& from, const scene::Job& job,
                                    const scene::View& view, const Snippets& snippets,
                                    const Outputs& outputs)
{
    const methods::LookupTraits traits = methods::traits(job);
    const scene::LookupSettings& settings = job.lookup;
    Definitions definitions{
        {"MAPS", std::to_string(view.maps.size())},
        {"TAPS_ACROSS", std::to_string(traits.width_texels)},
        {"KERNEL_ACROSS", std::to_string(traits.kernel.width_texels())},
        {"INTERPOLATES", flag(traits.interpolates())},
        {"OUTSIDE_CLAMP", flag(settings.outside == Outside::clamp)},
        {"OUTSIDE_VERDICT", settings.outside == Outside::shadowed ? "0.0" : "1.0"},
        {"REVERSED", flag(from.map.reversed)},
        {"POSITIONAL", flag(view.light.has_position())},
        {"PRIMITIVES", flag(snippets.passes.draws_primitives)},
        {"CUBE", flag(is_cube(view))},
        {"POSITION_OF_PIXEL", flag(is_position_of_pixel(job))},
        {"FINDS_CRITICAL_BIAS", flag(outputs.critical_bias)},
        {"WRITES_TERMS", flag(outputs.terms)},
        {"GRADIENTS", flag(snippets.passes.has_gradients())},
        {"HAS_RECEIVER_DEPTH", flag(outputs.depths.own != nullptr)},
        {"BLENDS", flag(!view.slices.mixed_from.empty())},
        {"SCALED_BIAS", flag(!view.bias_scales.empty())},
        {"TAP_GRADIENT", flag(has_gradient_of_taps(snippets.biases))},
    };
    std::ranges::copy(measure_definitions(traits_of(view.first_map().content).measure),
                      std::back_inserter(definitions));
    add_definitions(traits.taps, definitions);
    add_definitions(snippets.passes.lookup, definitions);
    for (const methods::ActiveBias& bias : snippets.biases) {
        add_definitions(bias.snippet, definitions);
    }
    return definitions;
}

const Program& LookupPass::program(const LookupSource& from, const scene::Job& job,
                                   const scene::View& view, const Snippets& snippets,
                                   const Outputs& outputs)
{
    Definitions defined = definitions(from, job, view, snippets, outputs);
    const std::string biases = map_choice(view) + bias_functions(snippets.biases) +
                               scattered_taps_source(methods::traits(job).taps);
    std::string key = program_key(biases + std::string{snippets.passes.lookup.glsl}, defined);
    const auto found = programs_.find(key);
    if (found != programs_.end()) {
        return found->second;
    }
    Program made = make_program(
        {"fullscreen.vert", "lookup.frag", std::move(defined), nullptr,
         std::string{shader_source("receiver_angle.glsl")} +
             std::string{shader_source("stored_measure.glsl")} +
             snippets_before_shader("lookup_map.glsl", snippets.passes.lookup, biases)});
    return programs_.emplace(std::move(key), std::move(made)).first->second;
}

void LookupPass::allocate(const scene::View& view, bool scatters)
{
    const scene::ImageSize size = view.image;
    const bool has_maps = view.maps.size() > 1;
    const bool has_next = !view.slices.mixed_from.empty();
    if (size_ == size && has_maps != maps_.empty() && has_next != next_texels_.empty() &&
        scatters != kernel_axes_.empty()) {
        return;
    }
    const auto made_if = [&](bool is_asked, GLenum format) {
        return is_asked ? make_texture(format, size.width_px, size.height_px) : Texture{};
    };
    samples_ = made_if(true, GL_RGBA32F);
    texels_ = made_if(true, GL_RG32F);
    maps_ = made_if(has_maps, GL_R8UI);
    next_texels_ = made_if(has_next, GL_RG32F);
    kernel_axes_ = made_if(scatters, GL_RG32F);
    target_ = make_framebuffer();
    std::array<GLenum, 5> outputs{};
    GLenum attachment = GL_COLOR_ATTACHMENT0;
    for (const Texture* texture : {&samples_, &texels_, &maps_, &next_texels_, &kernel_axes_}) {
        const bool is_written = !texture->empty();
        outputs.at(attachment - GL_COLOR_ATTACHMENT0) = is_written ? attachment : GL_NONE;
        glNamedFramebufferTexture(target_.name(), attachment, texture->name(), 0);
        ++attachment;
    }
    glNamedFramebufferDrawBuffers(target_.name(), static_cast<GLsizei>(outputs.size()),
                                  outputs.data());
    context_.check(fmt::format("allocating a {}×{} lookup", size.width_px, size.height_px));
    size_ = size;
}

void LookupPass::bind_cube(const Texture& faces, const methods::Passes& passes) const
{
    if (passes.sampling == Sampling::compared) {
        glBindTextureUnit(4, faces.name());
    } else {
        glBindTextureUnit(8, faces.name());
        glBindSampler(8, map_sampler_.name());
    }
}

void LookupPass::bind_map(const LookupSource& from, const methods::Passes& passes,
                          Outside outside) const
{
    const bool has_filtered = !passes.prefilter.empty();
    if (has_filtered && (from.filtered == nullptr || from.filtered->empty())) {
        throw std::invalid_argument("LookupPass: the map was not prefiltered");
    }
    const bool interpolates = passes.sampling == Sampling::interpolated;
    const ShadowMap& map = from.map;
    const auto& depth_border = border_of(depth_ends, outside, map.reversed);
    set_sampler(map_sampler_, interpolates && !has_filtered ? GL_LINEAR : GL_NEAREST, outside,
                depth_border);
    set_sampler(compare_sampler_, GL_LINEAR, outside, depth_border);
    glSamplerParameteri(compare_sampler_.name(), GL_TEXTURE_COMPARE_MODE,
                        GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(compare_sampler_.name(), GL_TEXTURE_COMPARE_FUNC,
                        map.reversed ? GL_GEQUAL : GL_LEQUAL);
    if (passes.draws_primitives) {
        if (map.primitive.empty()) {
            throw std::invalid_argument("LookupPass: the map was drawn without primitives");
        }
        glBindTextureUnit(10, map.primitive.name());
    }
    glBindTextureUnit(3, map.depth.name());
    glBindSampler(3, map_sampler_.name());
    if (passes.sampling == Sampling::compared) {
        glBindTextureUnit(4, map.depth.name());
        glBindSampler(4, compare_sampler_.name());
    }
    if (has_filtered) {
        set_sampler(filtered_sampler_, interpolates ? GL_LINEAR : GL_NEAREST, outside,
                    border_of(passes.of_ends, outside, map.reversed));
        if (passes.makes_mipmaps) {
            glSamplerParameteri(filtered_sampler_.name(), GL_TEXTURE_MIN_FILTER,
                                GL_LINEAR_MIPMAP_LINEAR);
        }
        set_anisotropy(filtered_sampler_, passes.anisotropy, context_);
        glBindTextureUnit(6, from.filtered->name());
        glBindSampler(6, filtered_sampler_.name());
    }
}

void LookupPass::render(const LookupSource& from, const scene::Job& job, const scene::View& view,
                        const renderers::ReceiverDepths& receiver_depths)
{
    const methods::LookupTraits traits = methods::traits(job);
    allocate(view, traits.scatters_taps());
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    draw(from, job, view, {.depths = receiver_depths});
    equal_taps_ = traits.equal_taps();
    context_.check("looking up the shadow map");
}

scene::Image<float> LookupPass::find_critical_biases(const LookupSource& from,
                                                     const scene::Job& job, const scene::View& view,
                                                     const Bisection& asked)
{
    const scene::ImageSize size = view.image;
    const Texture criticals = make_texture(GL_R32F, size.width_px, size.height_px);
    const Framebuffer target = make_framebuffer();
    glNamedFramebufferTexture(target.name(), GL_COLOR_ATTACHMENT0, criticals.name(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    draw(from, job, view,
         {.critical_bias = true, .depths = asked.receiver_depths, .lit_from = asked.lit_from});
    auto found = read_texture<float>(criticals, size, GL_RED, GL_FLOAT);
    context_.check("finding critical biases");
    return found;
}

scene::LookupTerms LookupPass::read_terms(const LookupSource& from, const scene::Job& job,
                                          const scene::View& view)
{
    const scene::ImageSize size = view.image;
    const Texture moved = make_texture(GL_RGBA32F, size.width_px, size.height_px);
    const Texture gradients = make_texture(GL_RG32F, size.width_px, size.height_px);
    const Framebuffer target = make_framebuffer();
    constexpr std::array<GLenum, 2> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferTexture(target.name(), outputs[0], moved.name(), 0);
    glNamedFramebufferTexture(target.name(), outputs[1], gradients.name(), 0);
    glNamedFramebufferDrawBuffers(target.name(), static_cast<GLsizei>(outputs.size()),
                                  outputs.data());
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    draw(from, job, view, {.terms = true});
    scene::LookupTerms terms{read_texture<scene::Vec4f>(moved, size, GL_RGBA, GL_FLOAT)};
    if (has_gradient_of_taps(methods::active_biases(job, view))) {
        terms.gradients = read_texture<scene::Vec2f>(gradients, size, GL_RG, GL_FLOAT);
    }
    context_.check("reading the bias terms of a lookup");
    return terms;
}

void LookupPass::draw(const LookupSource& from, const scene::Job& job, const scene::View& view,
                      const Outputs& outputs)
{
    if (!(from.receivers.size == view.image)) {
        throw std::invalid_argument("LookupPass: the receivers' size differs from the view's");
    }
    require_maps(from.map, job, view);
    const methods::Passes passes = methods::passes(job);
    const std::vector<methods::ActiveBias> biases = methods::active_biases(job, view);
    const Program& lookup = program(from, job, view, {passes, biases}, outputs);
    set_uniforms(lookup, view);
    set_uniform(lookup, "resolution", static_cast<float>(from.map.resolution_texels));
    set_uniform(lookup, "lit_from", outputs.lit_from);
    set_uniforms(lookup, methods::traits(job).taps, view, from.map.resolution_texels);
    set_uniforms(lookup, passes.lookup);
    for (const methods::ActiveBias& bias : biases) {
        set_uniforms(lookup, bias.snippet);
    }

    glViewport(0, 0, view.image.width_px, view.image.height_px);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    bind_receivers(from, biases);
    bind_map(from, passes, job.lookup.outside);
    Texture faces;
    if (is_cube(view) && passes.sampling != Sampling::fetched) {
        faces = from.map.depth.cube_view();
        bind_cube(faces, passes);
    }
    const Texture depths = upload_depths(outputs.depths.own, 7);
    const Texture next_depths = upload_depths(outputs.depths.next, 9);
    glBindVertexArray(no_attributes_.name());
    glUseProgram(lookup.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    for (const GLuint unit : {3U, 4U, 6U, 8U}) {
        glBindSampler(unit, 0);
    }
    glUseProgram(
        0); // else drivers validate bindings against the program's samplers, even for a clear
    glFinish();
}

scene::LookupLayers LookupPass::read() const
{
    scene::LookupLayers layers{
        read_texture<scene::LookupSample>(samples_, size_, GL_RGBA, GL_FLOAT),
        read_texture<scene::Vec2f>(texels_, size_, GL_RG, GL_FLOAT)};
    if (equal_taps_ > 1) {
        round_to_taps(layers.samples, equal_taps_);
    }
    if (!maps_.empty()) {
        layers.maps = read_texture<std::uint8_t>(maps_, size_, GL_RED_INTEGER, GL_UNSIGNED_BYTE);
    }
    if (!next_texels_.empty()) {
        layers.next_texels = read_texture<scene::Vec2f>(next_texels_, size_, GL_RG, GL_FLOAT);
    }
    if (!kernel_axes_.empty()) {
        layers.kernel_axes = read_texture<scene::Vec2f>(kernel_axes_, size_, GL_RG, GL_FLOAT);
    }
    context_.check("reading the lookup");
    return layers;
}

} // namespace gnomon::raster_gl
