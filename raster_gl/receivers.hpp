#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace gnomon::raster_gl {

/// The camera's G-buffer.
struct ReceiverBuffer {
    Texture triangle;       ///< R32UI: index of GL's triangle T, `no_triangle` for none
    Texture light_clip;     ///< RGBA32F: light clip coordinates, interpolated from the vertices
    Texture world_position; ///< RGBA32F: interpolated world position [m], 1
    /// RGBA32F: interpolated vertex normal, not normalised, 0; empty if the scene has no normals
    Texture vertex_normal;
    Texture depth; ///< D32F, reversed, near = 1e-6 × the scene's diagonal
    scene::ImageSize size{0, 0};
};

/// Draws the receivers from the camera, with vertex normals if the scene has them. The buffer
/// depends only on camera and image size, except `light_clip`, which uses the matrix of the light's
/// first map; lookups in several maps ignore it.
class ReceiverPass {
public:
    explicit ReceiverPass(const Context& context);

    /// @param box  the scene's bounds, which set the near plane (`scene::camera_clip_from_world`).
    /// @return  The pass's own buffer, overwritten by the next call.
    /// @throws scene::InputError  if the driver lacks the image size.
    const ReceiverBuffer& render(const GpuScene& scene, const scene::View& view,
                                 const scene::Box& box);
    /// Moves out the buffer that was drawn last.
    [[nodiscard]] ReceiverBuffer take();
    /// Takes back an unused buffer to recycle its textures.
    void give_back(ReceiverBuffer buffer) { buffer_ = std::move(buffer); }
    /// Frees the buffer.
    void forget() { static_cast<void>(take()); }

private:
    void allocate(scene::ImageSize size, bool has_normals);
    void attach() const;

    const Context& context_;
    Program program_;
    Program program_with_normals_; ///< compiled on first use
    Framebuffer target_;
    ReceiverBuffer buffer_;
};

/// The triangle index per pixel, or `no_triangle`; top left first.
[[nodiscard]] scene::Image<std::uint32_t> read_triangles(const Context& context,
                                                         const ReceiverBuffer& buffer);
/// Interpolated light clip coordinates per pixel; 0 without a receiver.
[[nodiscard]] scene::Image<scene::Vec4f> read_light_clip(const Context& context,
                                                         const ReceiverBuffer& buffer);
/// Interpolated world position (x, y, z, 1) per pixel [m]; 0 without a receiver.
[[nodiscard]] scene::Image<scene::Vec4f> read_world_positions(const Context& context,
                                                              const ReceiverBuffer& buffer);
/// Interpolated vertex normal (x, y, z, 0) per pixel, not normalised; 0 without a receiver.
/// Precondition: the buffer has normals.
[[nodiscard]] scene::Image<scene::Vec4f> read_vertex_normals(const Context& context,
                                                             const ReceiverBuffer& buffer);

/// Captures by transform feedback the clip position that the vertex shader computes for each
/// vertex, bit for bit: the input of GL's rasterizer.
/// @return  In the order of the scene's vertices.
[[nodiscard]] std::vector<scene::Vec4f> capture_clip_positions(const Context& context,
                                                               const GpuScene& scene,
                                                               const scene::Mat4f& clip_from_world);

} // namespace gnomon::raster_gl
