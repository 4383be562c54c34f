#pragma once

#include "methods/polygon_offset.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/layered_texture.hpp"
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

/// A light's rendered shadow map, or its several maps as layers.
struct ShadowMap {
    LayeredTexture depth; ///< what lookups sample: a depth texture, or of colour formats a colour
    /// Of formats that the shader converts, where codes are kept: R32UI, the code.
    LayeredTexture code;
    LayeredTexture unquantised_z; ///< the same: R32F, the z before it was converted
    /// R32UI, the triangle that each texel shows, or `scene::no_triangle`; empty unless asked for.
    LayeredTexture primitive;
    /// Of colour formats the depths that were tested, of all maps, each cleared before it is drawn.
    Texture colours_depth;
    scene::DepthFormat format;
    int resolution_texels = 0;
    bool reversed = false;
};

/// Whether formats that the shader converts keep their codes, and the z that they were made from,
/// beside the depths that lookups need: twice as many bytes again.
enum class ConvertedCodes : std::uint8_t { dropped, kept };

/// Whether a map keeps, beside depths, which triangle each texel shows.
enum class Primitives : std::uint8_t { dropped, kept };

/// Draws the casters from the light: depths, and where it is asked for triangles.
///
/// One light's maps are kept, until they are taken, and their textures are reused while format,
/// resolution and number stay the same: a sweep that loops over them outermost allocates each once.
class ShadowMapPass {
public:
    explicit ShadowMapPass(const Context& context, ConvertedCodes codes = ConvertedCodes::kept);

    /// @param maps    of a light, drawn in their order.
    /// @param offset  that their depths are drawn with.
    /// @param rows    that are drawn; what the others hold is not specified. Empty: all of them.
    /// @return  The pass's own maps; the next call overwrites them.
    /// @throws scene::InputError        if the driver substitutes the format or lacks the size.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    const ShadowMap& render(const GpuScene& scene, std::span<const scene::LightFrustum> maps,
                            const scene::ShadowMapSettings& settings,
                            Primitives primitives = Primitives::dropped,
                            const std::optional<methods::PolygonOffset>& offset = {},
                            const std::optional<scene::TexelRows>& rows = {});
    /// Stores these depths in place of drawn ones, as d32f.
    /// @param depths  As shaders shall see them (`scene::maps_image_size`).
    const ShadowMap& store(scene::Image<float> depths, bool reversed);
    /// The map that was drawn or stored last, which is the pass's own no longer.
    [[nodiscard]] ShadowMap take();
    /// Takes a map that nobody needs: its textures are used again where the next one is like it. A
    /// large one's memory is given back at once.
    void give_back(ShadowMap map);
    /// Gives the map's memory back; what `render` returned is empty until the next map.
    void forget();

private:
    /// Gives the textures back; at once beside a map of so many texels a side that is large.
    void release(int largest_texels);
    void allocate(const scene::ShadowMapSettings& settings, std::size_t maps,
                  Primitives primitives = Primitives::dropped);
    /// What the shader writes beside depth, and where.
    void allocate_outputs(scene::DepthFormat format, int side_texels, std::size_t maps,
                          Primitives primitives);
    /// Draws to the outputs that the map has from now on.
    void draw_to_outputs() const;
    [[nodiscard]] const Program& program_of(const CasterOutput& output);
    /// Draws to that map from now on.
    void attach(std::size_t map);

    const Context& context_;
    ConvertedCodes codes_;
    std::map<CasterOutput, Program> programs_;
    Framebuffer target_;
    ShadowMap map_;
};

/// The stored codes (`scene::maps_image_size`): integers; of floats their bits, of rgba8 its bytes,
/// the first one uppermost.
/// @throws std::invalid_argument  for a format that the shader converts and whose codes were
/// dropped.
[[nodiscard]] scene::Image<std::uint32_t> read_codes(const Context& context, const ShadowMap& map);

/// Of formats that the shader converts the float32 z that it converted (`scene::maps_image_size`).
/// @throws std::invalid_argument  for GL's own formats, which keep no such z, and where it was
///                                dropped.
[[nodiscard]] scene::Image<float> read_unquantised_z(const Context& context, const ShadowMap& map);

/// The triangle that each texel shows, or `scene::no_triangle` (`scene::maps_image_size`).
/// @throws std::invalid_argument  if the map was drawn without its primitives.
[[nodiscard]] scene::Image<std::uint32_t> read_primitives(const Context& context,
                                                          const ShadowMap& map);

/// The depths as shaders see them (`scene::maps_image_size`). Reading a depth texture as floats
/// gives other bits on some drivers, so a shader writes them.
[[nodiscard]] scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map);
/// The same of these rows of each map; 0 in the others.
[[nodiscard]] scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map,
                                                     scene::TexelRows rows);

} // namespace gnomon::raster_gl
