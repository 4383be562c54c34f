#pragma once

#include "raster_gl/caster_state.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/layered_texture.hpp"
#include "raster_gl/program.hpp"
#include "scene/image.hpp"
#include "scene/job/job.hpp"
#include "scene/pixel_layers.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::raster_gl {

/// A light's rendered shadow map, or its several maps as layers; the textures belong to the pass
/// that rendered them.
struct ShadowMap {
    LayeredTexture depth;         ///< depth texture: what lookups sample
    LayeredTexture code;          ///< u-formats, where codes are kept: R32UI, the n-bit code
    LayeredTexture unquantised_z; ///< u-formats, where codes are kept: R32F, the z before it was
                                  ///< quantised
    scene::DepthFormat format;
    int resolution_texels = 0;
    bool reversed = false;
};

/// Whether u-formats keep their codes, and the z that they were made from, beside the depths that
/// lookups need: twice as many bytes again.
enum class UnormCodes : std::uint8_t { dropped, kept };

/// Draws the casters from the light, depth only.
///
/// One light's maps are kept and their textures are reused while format, resolution and number stay
/// the same: a sweep that loops over them outermost allocates each once.
class ShadowMapPass {
public:
    explicit ShadowMapPass(const Context& context, UnormCodes codes = UnormCodes::kept);

    /// @param maps  of a light, drawn in their order.
    /// @return  The pass's own maps; the next call overwrites them.
    /// @throws scene::InputError        if the driver substitutes the format or lacks the size.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    const ShadowMap& render(const GpuScene& scene, std::span<const scene::LightFrustum> maps,
                            const scene::ShadowMapSettings& settings);
    /// The same maps in these rows alone; what the others hold is not specified.
    const ShadowMap& render(const GpuScene& scene, std::span<const scene::LightFrustum> maps,
                            const scene::ShadowMapSettings& settings, scene::TexelRows rows);
    /// Stores these depths in place of drawn ones, as d32f.
    /// @param depths  As shaders shall see them (`scene::maps_image_size`).
    const ShadowMap& store(scene::Image<float> depths, bool reversed);
    /// Gives the map's memory back; what `render` returned is empty until the next map.
    void forget();

private:
    /// Gives the textures back; at once beside a map of so many texels a side that is large.
    void release(int largest_texels);
    void allocate(const scene::ShadowMapSettings& settings, std::size_t maps);
    [[nodiscard]] const Program& program_of(const CasterOutput& output);
    /// Draws to that map from now on.
    void attach(std::size_t map);

    const Context& context_;
    UnormCodes codes_;
    Program depth_only_;
    Program unorm_;
    std::optional<Program> distance_; ///< made when first asked for, as the next
    std::optional<Program> distance_unorm_;
    Framebuffer target_;
    ShadowMap map_;
};

/// The stored codes (`scene::maps_image_size`): d16, d24, d32 and u-formats as integers, d32f as
/// float bits.
/// @throws std::invalid_argument  for a u-format whose codes were dropped.
[[nodiscard]] scene::Image<std::uint32_t> read_codes(const Context& context, const ShadowMap& map);

/// u-formats: the float32 z that the shader quantised (`scene::maps_image_size`).
/// @throws std::invalid_argument  for GL's own formats, which keep no such z, and where it was
///                                dropped.
[[nodiscard]] scene::Image<float> read_unquantised_z(const Context& context, const ShadowMap& map);

/// The depths as shaders see them (`scene::maps_image_size`). Reading a depth texture as floats
/// gives other bits on some drivers, so a shader writes them.
[[nodiscard]] scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map);
/// The same of these rows of each map; 0 in the others.
[[nodiscard]] scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map,
                                                     scene::TexelRows rows);

} // namespace gnomon::raster_gl
