#include "raster_gl/map/shadow_map.hpp"

#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/readback.hpp"
#include "raster_gl/scene_programs.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::raster_gl {
namespace {

using Kind = scene::DepthFormat::Kind;

bool is_converted(scene::DepthFormat format)
{
    return traits_of(format).conversion == scene::Conversion::shader;
}

/// Output locations of written_casters.glsl.
constexpr GLint colour_output = 0;
constexpr GLint code_output = 1;
constexpr GLint z_output = 2;
constexpr GLint primitive_output = 3;

GLenum attachment_of(GLint output)
{
    return GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(output);
}

/// Clears all attachments to the far plane's values.
void clear(const Framebuffer& target, const ShadowMap& map)
{
    const float far_depth = map.reversed ? 0.0F : 1.0F;
    glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &far_depth);
    const std::array<GLfloat, 4> z{far_depth};
    if (traits_of(map.format).is_colour) {
        glClearNamedFramebufferfv(target.name(), GL_COLOR, colour_output, z.data());
    }
    if (!map.code.empty()) {
        const std::array<GLuint, 4> code{map.reversed ? 0U : scene::code_of_one(map.format)};
        glClearNamedFramebufferuiv(target.name(), GL_COLOR, code_output, code.data());
        glClearNamedFramebufferfv(target.name(), GL_COLOR, z_output, z.data());
    }
    if (!map.primitive.empty()) {
        constexpr std::array<GLuint, 4> nothing{scene::no_triangle};
        glClearNamedFramebufferuiv(target.name(), GL_COLOR, primitive_output, nothing.data());
    }
}

/// GL widens an n-bit code to 32 bits by rounding or by bit replication. Both give code·(2^32 −
/// 1)/(2^n − 1) to the nearest integer, so the rounded inverse is the code.
std::uint32_t narrow_code(std::uint32_t widened, double scale)
{
    return static_cast<std::uint32_t>(std::llround(widened * scale));
}

/// A float texture with a framebuffer to draw into it.
class FloatTarget {
public:
    FloatTarget(int width_px, int height_px) : texture_{make_texture(GL_R32F, width_px, height_px)}
    {
        glNamedFramebufferTexture(target_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0);
    }
    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, target_.name()); }
    [[nodiscard]] const Texture& texture() const { return texture_; }

private:
    Texture texture_;
    Framebuffer target_ = make_framebuffer();
};

/// Copies depths as shaders read them into a band of rows.
class DepthCopy {
public:
    DepthCopy(int width_texels, int rows) : band_{width_texels, rows}, size_{width_texels, rows}
    {
        band_.bind();
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glUseProgram(program_.name());
        glBindSampler(0, 0);
        glBindVertexArray(no_attributes_.name());
    }

    /// @param rows  at most the band's; its other rows stay unchanged.
    void draw(const Texture& depths, int first_row, int rows) const
    {
        glBindTextureUnit(0, depths.name());
        glViewport(0, 0, size_.width_px, rows);
        set_uniform(program_, "first_row", static_cast<std::uint32_t>(first_row));
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    /// The band, its last row first.
    [[nodiscard]] scene::Image<float> read() const
    {
        return read_texture<float>(band_.texture(), size_, GL_RED, GL_FLOAT);
    }

private:
    FloatTarget band_;
    scene::ImageSize size_;
    VertexArray no_attributes_ = make_vertex_array();
    Program program_ = make_program({"fullscreen.vert", "map_depths.frag", {}, nullptr});
};

/// Level 0 of each layer, bit for bit (`scene::maps_image_size`).
template <typename Pixel>
scene::Image<Pixel> read_layers(const LayeredTexture& texture, int resolution_texels, GLenum format,
                                GLenum type)
{
    const scene::ImageSize size{resolution_texels, resolution_texels};
    if (texture.layer_count() == 1) {
        return read_texture<Pixel>(texture.layer(0), size, format, type);
    }
    scene::Image<Pixel> all{scene::maps_image_size(resolution_texels, texture.layer_count())};
    Pixel* next = all.data();
    for (std::size_t i = 0; i < texture.layer_count(); ++i) {
        const auto layer = read_texture<Pixel>(texture.layer(i), size, format, type);
        next = std::copy(layer.begin(), layer.end(), next);
    }
    return all;
}

/// Scope in which draws and clears affect only these rows, if given.
class ScissorRows {
public:
    ScissorRows(const std::optional<scene::TexelRows>& rows, int width_texels)
    {
        if (rows) {
            glEnable(GL_SCISSOR_TEST);
            glScissor(0, rows->first, width_texels, rows->count);
        }
    }
    ScissorRows(const ScissorRows&) = delete;
    ScissorRows& operator=(const ScissorRows&) = delete;
    ~ScissorRows() { glDisable(GL_SCISSOR_TEST); }
};

/// Makes the driver release deleted textures. Drivers keep one until a draw samples another texture
/// in its unit. Mesa's software renderer also keeps a finished draw's target and triangles until
/// another draw takes its slot. It takes the first free slot, so later slots are used only while
/// earlier draws are running.
void flush_deleted_textures()
{
    constexpr int slots = 64; // MAX_SCENES of Mesa's lp_setup_context.h
    constexpr int side_px = 2048;
    const Texture pixel = make_texture(GL_R32F, 1, 1);
    const DepthCopy long_copy{side_px, side_px};
    std::vector<FloatTarget> targets;
    for (int i = 1; i < slots; ++i) {
        targets.emplace_back(1, 1);
    }
    long_copy.draw(pixel, 0, side_px);
    for (const FloatTarget& target : targets) {
        target.bind();
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glFinish();
}

} // namespace

ShadowMapPass::ShadowMapPass(const Context& context, ConvertedCodes codes)
    : context_{context},
      codes_{codes}
{
    // Compile the usual programs now, so that no map waits for them.
    (void)program_of({});
    (void)program_of({.converted = Kind::unorm});
    context.check("compiling the shadow map programs");
}

void ShadowMapPass::release(int largest_texels)
{
    map_ = {};
    target_ = make_framebuffer();
    if (is_large_map(largest_texels)) {
        flush_deleted_textures();
    }
}

ShadowMap ShadowMapPass::take()
{
    target_ = make_framebuffer(); // a framebuffer keeps its attachments alive
    return std::exchange(map_, {});
}

void ShadowMapPass::give_back(ShadowMap map)
{
    map_ = std::move(map);
    if (is_large_map(map_.resolution_texels)) {
        forget();
    }
}

void ShadowMapPass::forget()
{
    release(map_.resolution_texels);
}

void ShadowMapPass::allocate(const scene::ShadowMapSettings& settings, std::size_t maps,
                             Primitives primitives)
{
    const int size = settings.resolution_texels;
    const int largest =
        std::min(context_.facts().max_texture_texels, context_.facts().max_viewport_px);
    if (size > largest) {
        throw scene::InputError(fmt::format(
            "shadow_map.resolution = {}: this driver's largest map is {} texels", size, largest));
    }
    if (map_.resolution_texels == size && map_.format == settings.depth_format &&
        map_.depth.layer_count() == maps &&
        map_.primitive.empty() == (primitives == Primitives::dropped)) {
        return;
    }
    // Free the old textures before allocating the new ones.
    release(std::max(size, map_.resolution_texels));
    map_.depth = LayeredTexture{internal_format(settings.depth_format), size, maps};
    require_format(map_.depth.layer(0), settings.depth_format);
    allocate_outputs(settings.depth_format, size, maps, primitives);
    context_.check(fmt::format("allocating {2} {0}×{0} {1} shadow map{3}", size,
                               scene::depth_format_name(settings.depth_format),
                               maps == 1 ? "a" : std::to_string(maps), maps == 1 ? "" : "s"));
    map_.format = settings.depth_format;
    map_.resolution_texels = size;
}

void ShadowMapPass::allocate_outputs(scene::DepthFormat format, int side_texels, std::size_t maps,
                                     Primitives primitives)
{
    if (traits_of(format).is_colour) {
        map_.colours_depth = make_texture(GL_DEPTH_COMPONENT32F, side_texels, side_texels);
    }
    if (is_converted(format) && codes_ == ConvertedCodes::kept) {
        map_.code = LayeredTexture{GL_R32UI, side_texels, maps};
        map_.unquantised_z = LayeredTexture{GL_R32F, side_texels, maps};
    }
    if (primitives == Primitives::kept) {
        map_.primitive = LayeredTexture{GL_R32UI, side_texels, maps};
    }
}

void ShadowMapPass::draw_to_outputs() const
{
    std::array<GLenum, 4> buffers{GL_NONE, GL_NONE, GL_NONE, GL_NONE};
    for (const auto& [is_there, output] : {std::pair{!map_.colours_depth.empty(), colour_output},
                                           {!map_.code.empty(), code_output},
                                           {!map_.unquantised_z.empty(), z_output},
                                           {!map_.primitive.empty(), primitive_output}}) {
        if (is_there) {
            buffers.at(static_cast<std::size_t>(output)) = attachment_of(output);
        }
    }
    glNamedFramebufferDrawBuffers(target_.name(), static_cast<GLsizei>(buffers.size()),
                                  buffers.data());
}

const Program& ShadowMapPass::program_of(const CasterOutput& output)
{
    const auto found = programs_.find(output);
    return found != programs_.end()
               ? found->second
               : programs_.emplace(output, make_caster_program(output)).first->second;
}

void ShadowMapPass::attach(std::size_t map)
{
    const auto attach_texture = [&](GLenum attachment, const Texture& texture) {
        glNamedFramebufferTexture(target_.name(), attachment, texture.name(), 0);
    };
    if (map_.colours_depth.empty()) {
        attach_texture(GL_DEPTH_ATTACHMENT, map_.depth.layer(map));
    } else {
        attach_texture(GL_DEPTH_ATTACHMENT, map_.colours_depth);
        attach_texture(attachment_of(colour_output), map_.depth.layer(map));
    }
    if (!map_.code.empty()) {
        attach_texture(attachment_of(code_output), map_.code.layer(map));
        attach_texture(attachment_of(z_output), map_.unquantised_z.layer(map));
    }
    if (!map_.primitive.empty()) {
        attach_texture(attachment_of(primitive_output), map_.primitive.layer(map));
    }
}

const ShadowMap& ShadowMapPass::render(const GpuScene& scene,
                                       std::span<const scene::LightFrustum> maps,
                                       const scene::ShadowMapSettings& settings,
                                       Primitives primitives,
                                       const std::optional<methods::PolygonOffset>& offset,
                                       const std::optional<scene::TexelRows>& rows)
{
    allocate(settings, maps.size(), primitives);
    const ScissorRows scissor_rows{rows, settings.resolution_texels};
    const scene::LightFrustum& first = maps.front();
    map_.reversed = first.reversed;
    const Program& program =
        program_of(caster_output(first.content, map_.format, primitives == Primitives::kept));
    draw_to_outputs();
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    prepare_to_draw_casters(first, settings);
    set_uniform(program, "largest_code", scene::code_of_one(map_.format));
    glUseProgram(program.name());
    const PolygonOffsetScope offset_scope{offset};
    for (std::size_t i = 0; i < maps.size(); ++i) {
        attach(i);
        clear(target_, map_);
        set_uniform(program, "clip_from_world", maps[i].light_clip_from_world);
        set_uniform(program, "light", scene::Vec3f{maps[i].origin});
        set_uniform(program, "origin", static_cast<float>(maps[i].stored_range().near_m));
        set_uniform(program, "far", static_cast<float>(maps[i].far_m));
        draw_casters(scene, program, map_.resolution_texels);
    }
    glFinish();
    context_.check("rendering the shadow map");
    return map_;
}

const ShadowMap& ShadowMapPass::store(scene::Image<float> depths, bool reversed)
{
    scene::ShadowMapSettings settings;
    settings.resolution_texels = depths.size().width_px;
    settings.depth_format = scene::float_depth_format;
    const int side = settings.resolution_texels;
    allocate(settings, static_cast<std::size_t>(depths.size().height_px / side));
    map_.reversed = reversed;
    const auto store_map = [&](std::size_t i, scene::Image<float> map) {
        flip_rows(map);
        glTextureSubImage2D(map_.depth.layer(i).name(), 0, 0, 0, side, side, GL_DEPTH_COMPONENT,
                            GL_FLOAT, map.data());
    };
    if (map_.depth.layer_count() == 1) {
        store_map(0, std::move(depths));
    } else {
        for (std::size_t i = 0; i < map_.depth.layer_count(); ++i) {
            store_map(i, scene::image_of_map(depths, i));
        }
    }
    context_.check("storing a shadow map");
    return map_;
}

scene::Image<std::uint32_t> read_codes(const Context& context, const ShadowMap& map)
{
    if (is_converted(map.format) && map.code.empty()) {
        throw std::invalid_argument("read_codes: map: the codes were dropped");
    }
    const auto read = [&] {
        if (!map.code.empty()) {
            return read_layers<std::uint32_t>(map.code, map.resolution_texels, GL_RED_INTEGER,
                                              GL_UNSIGNED_INT);
        }
        // Floats are read as their bits.
        return read_layers<std::uint32_t>(map.depth, map.resolution_texels, GL_DEPTH_COMPONENT,
                                          map.format.is_float() ? GL_FLOAT : GL_UNSIGNED_INT);
    };
    scene::Image<std::uint32_t> codes = read();
    context.check("reading the map's codes");
    if (map.format.kind == Kind::d16 || map.format.kind == Kind::d24) {
        const double scale = scene::code_of_one(map.format) / 4294967295.0;
        for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
            codes[i] = narrow_code(codes[i], scale);
        }
    }
    return codes;
}

scene::Image<float> read_unquantised_z(const Context& context, const ShadowMap& map)
{
    if (map.unquantised_z.empty()) {
        throw std::invalid_argument("read_unquantised_z: map: z is kept only with codes, for "
                                    "formats that the shader converts");
    }
    auto z = read_layers<float>(map.unquantised_z, map.resolution_texels, GL_RED, GL_FLOAT);
    context.check("reading the map's z");
    return z;
}

scene::Image<std::uint32_t> read_primitives(const Context& context, const ShadowMap& map)
{
    if (map.primitive.empty()) {
        throw std::invalid_argument("read_primitives: map: drawn without primitives");
    }
    auto primitives = read_layers<std::uint32_t>(map.primitive, map.resolution_texels,
                                                 GL_RED_INTEGER, GL_UNSIGNED_INT);
    context.check("reading the map's primitives");
    return primitives;
}

scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map)
{
    return read_shader_depths(context, map, {0, map.resolution_texels});
}

scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map,
                                       scene::TexelRows rows)
{
    // Reads in bands, so that a large map needs no third copy.
    const int resolution = map.resolution_texels;
    const int band_rows = std::min(rows.count, 256);
    const DepthCopy copy{resolution, band_rows};
    scene::Image<float> depths{scene::maps_image_size(resolution, map.depth.layer_count())};
    const int end = rows.first + rows.count;
    for (std::size_t i = 0; i < map.depth.layer_count(); ++i) {
        for (int first_row = rows.first; first_row < end; first_row += band_rows) {
            const int drawn = std::min(band_rows, end - first_row);
            copy.draw(map.depth.layer(i), first_row, drawn);
            // The band is read top row first, so a short last band fills its last rows.
            const auto band = copy.read();
            const scene::Texel top_left{0, first_row + drawn - 1, static_cast<int>(i)};
            std::copy_n(band.data() + std::ptrdiff_t{band_rows - drawn} * resolution,
                        std::ptrdiff_t{drawn} * resolution, &at_texel(depths, top_left));
        }
    }
    context.check("reading the map's depths");
    return depths;
}

} // namespace gnomon::raster_gl
