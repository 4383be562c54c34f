#pragma once

#include "methods/polygon_offset.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/program.hpp"
#include "raster_gl/scene_programs.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

namespace gnomon::raster_gl {

/// A light's shadow map, or its several maps as layers.
struct ShadowMap {
    LayeredTexture
        depth; ///< sampled by lookups: a depth texture, or a colour texture for colour formats
    /// R32UI codes; only for formats that the shader converts, if codes are kept.
    LayeredTexture code;
    LayeredTexture unquantised_z; ///< R32F z before conversion; present with `code`
    /// R32UI index of the triangle in each texel, or `scene::no_triangle`; empty unless requested.
    LayeredTexture primitive;
    /// Depth buffer for colour formats, shared by all maps and cleared for each.
    Texture colours_depth;
    scene::DepthFormat format;
    int resolution_texels = 0;
    bool reversed = false;
};

/// Whether formats that the shader converts keep their codes and unquantised z beside the depths,
/// which triples the memory.
enum class ConvertedCodes : std::uint8_t { dropped, kept };

/// Whether a map keeps the triangle of each texel beside its depth.
enum class Primitives : std::uint8_t { dropped, kept };

/// Draws the casters from the light: depths, and triangle indices on request.
///
/// Keeps one light's maps until they are taken, and reuses their textures while format, resolution
/// and number stay the same. A sweep with these in its outer loops allocates each once.
class ShadowMapPass {
public:
    explicit ShadowMapPass(const Context& context, ConvertedCodes codes = ConvertedCodes::kept);

    /// @param maps    of one light, drawn in order.
    /// @param offset  polygon offset of the casters.
    /// @param rows    to draw, others are undefined; empty for all.
    /// @return  The pass's own maps, overwritten by the next call.
    /// @throws scene::InputError        if the driver substitutes the format or lacks the size.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    const ShadowMap& render(const GpuScene& scene, std::span<const scene::LightFrustum> maps,
                            const scene::ShadowMapSettings& settings,
                            Primitives primitives = Primitives::dropped,
                            const std::optional<methods::PolygonOffset>& offset = {},
                            const std::optional<scene::TexelRows>& rows = {});
    /// Stores the given depths as a d32f map.
    /// @param depths  as shaders read them (`scene::maps_image_size`).
    const ShadowMap& store(scene::Image<float> depths, bool reversed);
    /// Moves out the map that was drawn or stored last.
    [[nodiscard]] ShadowMap take();
    /// Takes back an unused map to recycle its textures; frees a large one at once.
    void give_back(ShadowMap map);
    /// Frees the map's textures; the reference that `render` returned is empty until the next map.
    void forget();

private:
    /// Frees the textures; if the largest map is large, makes the driver release them at once.
    void release(int largest_texels);
    void allocate(const scene::ShadowMapSettings& settings, std::size_t maps,
                  Primitives primitives = Primitives::dropped);
    /// Allocates the textures that the shader writes beside depth.
    void allocate_outputs(scene::DepthFormat format, int side_texels, std::size_t maps,
                          Primitives primitives);
    /// Enables the draw buffers of the map's outputs.
    void draw_to_outputs() const;
    [[nodiscard]] const Program& program_of(const CasterOutput& output);
    /// Attaches a map's layers to the framebuffer.
    void attach(std::size_t map);

    const Context& context_;
    ConvertedCodes codes_;
    std::map<CasterOutput, Program> programs_;
    Framebuffer target_;
    ShadowMap map_;
};

/// The stored codes (`scene::maps_image_size`): integers, the bits of floats, or the bytes of rgba8
/// with the first uppermost.
/// @throws std::invalid_argument  if the shader converts the format and its codes were dropped.
[[nodiscard]] scene::Image<std::uint32_t> read_codes(const Context& context, const ShadowMap& map);

/// The float32 z before the shader converted it (`scene::maps_image_size`).
/// @throws std::invalid_argument  for GL's own formats, and if it was dropped.
[[nodiscard]] scene::Image<float> read_unquantised_z(const Context& context, const ShadowMap& map);

/// The triangle of each texel, or `scene::no_triangle` (`scene::maps_image_size`).
/// @throws std::invalid_argument  if the map was drawn without primitives.
[[nodiscard]] scene::Image<std::uint32_t> read_primitives(const Context& context,
                                                          const ShadowMap& map);

/// The depths as shaders read them (`scene::maps_image_size`). A shader copies them, as some
/// drivers return other bits when a depth texture is read back as floats.
[[nodiscard]] scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map);
/// Reads only these rows of each map; the others are 0.
[[nodiscard]] scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map,
                                                     scene::TexelRows rows);

} // namespace gnomon::raster_gl
