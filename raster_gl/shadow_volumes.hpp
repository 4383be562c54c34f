#pragma once

#include "methods/passes.hpp"
#include "raster_gl/context.hpp"
#include "raster_gl/gl_object.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "raster_gl/receivers.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace gnomon::raster_gl {

/// What volumes are counted for.
struct VolumeReceivers {
    const GpuScene& scene;
    const ReceiverBuffer& receivers;
};

/// Decides receivers by shadow volumes: the camera's view is drawn, and of the volumes' faces
/// behind it those that are left are counted up in the stencil, those that are entered down
/// (z-fail), so that what is left counts the volumes that hold the receiver.
///
/// The count is modulo 256. Faces at the receivers' own depths count as behind them, so that a ray
/// enters the volume of the receiver's own triangle there, and leaves it farther on. A light's
/// geometry is kept until another is asked for.
///
/// Sources: J. Carmack, 2000 (z-fail); C. Everitt, M. Kilgard, "Practical and robust stenciled
/// shadow volumes", 2002 (infinite ends); B. Kim et al., "A shadow volume algorithm for opaque and
/// transparent non-manifold casters", 2008 (edges with counts).
class ShadowVolumePass {
public:
    /// @param triangles  must outlive the pass.
    ShadowVolumePass(const Context& context, const scene::TriangleScene& triangles);

    /// @return  Images of the view's size, top left first: verdicts and tan θ; r, d and texels are
    ///          NaN.
    /// @throws std::invalid_argument  if the receivers are not of the view's size.
    /// @throws scene::InputError      if the volumes have more corners than GL draws.
    [[nodiscard]] scene::LookupLayers look_up(const VolumeReceivers& from, const scene::View& view,
                                              const methods::ShadowVolumes& volumes);

private:
    /// A range of the indices.
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
    };
    /// Faces whose winding, as GL sees it, is that of the volume's outside, or its reverse.
    struct Faces {
        Range near_caps; ///< the casters themselves
        Range rest;
    };
    /// What was uploaded last, and what for.
    struct Geometry {
        scene::Light light;
        methods::ShadowVolumes volumes;
        Buffer indices;
        Faces outward;
        Faces inward;
    };

    void upload_vertices();
    void prepare(const scene::Light& light, const methods::ShadowVolumes& volumes);
    void allocate(scene::ImageSize size);
    [[nodiscard]] const Program& volume_program(const scene::View& view);
    void draw_view(const VolumeReceivers& from, const Program& program) const;
    void count_volumes(const Program& program) const;
    void draw_faces(const Faces& faces, GLenum front) const;
    [[nodiscard]] scene::LookupLayers decide(const VolumeReceivers& from, const scene::View& view);

    const Context& context_;
    const scene::TriangleScene& triangles_;
    scene::Box box_;
    Program endless_;
    Program finite_;
    Program verdict_of_position_;
    Program verdict_of_direction_;
    VertexArray layout_;
    VertexArray no_attributes_;
    Buffer vertices_; ///< each twice; empty until there are volumes
    std::optional<Geometry> geometry_;
    Framebuffer counted_;
    Texture depth_stencil_;
    Framebuffer target_;
    Texture samples_;
    scene::ImageSize size_{0, 0};
};

} // namespace gnomon::raster_gl
