#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <utility>

namespace gnomon::raster_gl {

/// What the camera sees, on the GPU.
struct ReceiverBuffer {
    Texture triangle;       ///< R32UI: index of GL's triangle T, `no_triangle` for none
    Texture light_clip;     ///< RGBA32F: light clip coordinates, interpolated from the vertices
    Texture world_position; ///< RGBA32F: interpolated world position [m], 1
    /// RGBA32F: normal interpolated from the vertices, of any length, 0; empty where the scene has
    /// no normals
    Texture vertex_normal;
    Texture depth; ///< D32F, reversed, near = 1e-6 × the scene's diagonal
    scene::ImageSize size{0, 0};
};

/// Draws the receivers from the camera, with normals where the scene has them. Depends on camera
/// and image size only, `light_clip` on the matrix of the light's first map too: where a light has
/// several, lookups do not read it.
class ReceiverPass {
public:
    explicit ReceiverPass(const Context& context);

    /// @param box  the scene's bounds; decides the near plane (`scene::camera_clip_from_world`).
    /// @return  The pass's own buffer; the next call overwrites it.
    /// @throws scene::InputError  if the driver lacks the image size.
    const ReceiverBuffer& render(const GpuScene& scene, const scene::View& view,
                                 const scene::Box& box);
    /// The buffer that was drawn last, which is the pass's own no longer.
    [[nodiscard]] ReceiverBuffer take();
    /// Takes a buffer that nobody needs: its textures are used again where the next one is like it.
    void give_back(ReceiverBuffer buffer) { buffer_ = std::move(buffer); }
    /// Gives the buffer's memory back.
    void forget() { static_cast<void>(take()); }

private:
    void allocate(scene::ImageSize size, bool has_normals);
    void attach() const;

    const Context& context_;
    Program program_;
    Program program_with_normals_; ///< made when it is needed
    Framebuffer target_;
    ReceiverBuffer buffer_;
};

/// GL's triangle per pixel, or `no_triangle`, top left first.
[[nodiscard]] scene::Image<std::uint32_t> read_triangles(const Context& context,
                                                         const ReceiverBuffer& buffer);
/// Light clip coordinates per pixel, interpolated; all 0 where there is no receiver.
[[nodiscard]] scene::Image<scene::Vec4f> read_light_clip(const Context& context,
                                                         const ReceiverBuffer& buffer);
/// World position (x, y, z, 1) per pixel [m], interpolated; all 0 where there is no receiver.
[[nodiscard]] scene::Image<scene::Vec4f> read_world_positions(const Context& context,
                                                              const ReceiverBuffer& buffer);
/// Normal interpolated from the vertices (x, y, z, 0) per pixel, of any length; 0 where there is no
/// receiver.
/// Precondition: the buffer has normals.
[[nodiscard]] scene::Image<scene::Vec4f> read_vertex_normals(const Context& context,
                                                             const ReceiverBuffer& buffer);

} // namespace gnomon::raster_gl
