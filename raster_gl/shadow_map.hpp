#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/image.hpp"
#include "scene/job/job.hpp"
#include "scene/pixel_layers.hpp"

#include <cstdint>

namespace gnomon::raster_gl {

/// A rendered shadow map; its textures belong to the pass that rendered it.
struct ShadowMap {
    Texture depth;         ///< depth texture: what lookups sample
    Texture code;          ///< u-formats, where codes are kept: R32UI, the n-bit code
    Texture unquantised_z; ///< u-formats, where codes are kept: R32F, the z before it was quantised
    scene::DepthFormat format;
    int resolution_texels = 0;
    bool reversed = false;
};

/// Whether u-formats keep their codes, and the z that they were made from, beside the depths that
/// lookups need: twice as many bytes again.
enum class UnormCodes : std::uint8_t { dropped, kept };

/// Draws the casters from the light, depth only.
///
/// One map is kept and its textures are reused while format and resolution stay the same: a sweep
/// that loops over them outermost allocates each once.
class ShadowMapPass {
public:
    explicit ShadowMapPass(const Context& context, UnormCodes codes = UnormCodes::kept);

    /// @return  The pass's own map; the next call overwrites it.
    /// @throws scene::InputError        if the driver substitutes the format or lacks the size.
    /// @throws scene::EnvironmentError  if GL fails, memory included.
    const ShadowMap& render(const GpuScene& scene, const scene::LightFrustum& frustum,
                            const scene::ShadowMapSettings& settings);
    /// The same map in these rows alone; what the others hold is not specified.
    const ShadowMap& render(const GpuScene& scene, const scene::LightFrustum& frustum,
                            const scene::ShadowMapSettings& settings, scene::TexelRows rows);
    /// Stores these depths in place of drawn ones, as d32f.
    /// @param depths  As shaders shall see them, top left first, square.
    const ShadowMap& store(scene::Image<float> depths, bool reversed);
    /// Gives the map's memory back; what `render` returned is empty until the next map.
    void forget();

private:
    /// Gives the textures back; at once beside a map of so many texels a side that is large.
    void release(int largest_texels);
    void allocate(const scene::ShadowMapSettings& settings);

    const Context& context_;
    UnormCodes codes_;
    Program depth_only_;
    Program unorm_;
    Framebuffer target_;
    ShadowMap map_;
};

/// The stored codes, top left first: d16, d24, d32 and u-formats as integers, d32f as float bits.
/// @throws std::invalid_argument  for a u-format whose codes were dropped.
[[nodiscard]] scene::Image<std::uint32_t> read_codes(const Context& context, const ShadowMap& map);

/// u-formats: the float32 z that the shader quantised, top left first.
/// @throws std::invalid_argument  for GL's own formats, which keep no such z, and where it was
///                                dropped.
[[nodiscard]] scene::Image<float> read_unquantised_z(const Context& context, const ShadowMap& map);

/// The depths as shaders see them, top left first. Reading a depth texture as floats gives other
/// bits on some drivers, so a shader writes them.
[[nodiscard]] scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map);
/// The same of these rows; the image is of the map's size, and 0 in the others.
[[nodiscard]] scene::Image<float> read_shader_depths(const Context& context, const ShadowMap& map,
                                                     scene::TexelRows rows);

} // namespace gnomon::raster_gl
