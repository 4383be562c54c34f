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
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::raster_gl {

/// The receivers that volumes are counted for.
struct VolumeReceivers {
    const GpuScene& scene;
    const ReceiverBuffer& receivers;
};

/// Stencil shadow volumes, z-fail: draws the view's depths, then counts volume faces behind them,
/// back faces up and front faces down. The sum is the number of volumes that contain the receiver.
///
/// The count is modulo 256. Faces at a receiver's own depth count as behind it: the ray enters the
/// volume of the receiver's own triangle there and leaves it farther on. Keeps a light's geometry
/// until another light's is needed.
///
/// Sources: J. Carmack, 2000 (z-fail); C. Everitt, M. Kilgard, "Practical and robust stenciled
/// shadow volumes", 2002 (infinite ends); B. Kim et al., "A shadow volume algorithm for opaque and
/// transparent non-manifold casters", 2008 (edges with counts).
class ShadowVolumePass {
public:
    /// @param triangles  must outlive this object.
    ShadowVolumePass(const Context& context, const scene::TriangleScene& triangles);

    /// @return  Images of the view's size, top left first: verdicts and tan θ; r, d and texels are
    ///          NaN.
    /// @throws std::invalid_argument  if the receivers' size differs from the view's.
    /// @throws scene::InputError      if the volumes have more corners than GL draws.
    [[nodiscard]] scene::LookupLayers look_up(const VolumeReceivers& from, const scene::View& view,
                                              const methods::ShadowVolumes& volumes);

private:
    /// A range of the indices.
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
    };
    /// Faces of one winding.
    struct Faces {
        Range near_caps; ///< the casters themselves
        Range rest;
    };
    /// The uploaded volumes, and the light they are for.
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
    Program infinite_;
    Program finite_;
    Program verdict_of_position_;
    Program verdict_of_direction_;
    VertexArray layout_;
    VertexArray no_attributes_;
    Buffer vertices_; ///< each vertex twice; empty until first used
    std::optional<Geometry> geometry_;
    Framebuffer counted_;
    Texture depth_stencil_;
    Framebuffer target_;
    Texture samples_;
    scene::ImageSize size_{0, 0};
};

/// Shadow volume faces of one winding.
struct VolumeFaces {
    /// Caps: vertex indices of scene triangles.
    std::vector<std::array<std::uint32_t, 3>> caps;
    /// Sides: an edge's vertex indices (from, to); each is a quad (to, from, from at infinity, to
    /// at infinity).
    std::vector<std::array<std::uint32_t, 2>> sides;
};

/// The shadow volumes of a scene's casters, each extruded from its caster away from the light to
/// infinity.
struct VolumeGeometry {
    VolumeFaces along;   ///< facing out of the volume
    VolumeFaces against; ///< facing into the volume
};

/// Decides exactly, once per triangle, whether it casts. Casters that share an edge share a side:
/// `silhouette` omits it if its outward and inward uses cancel, `triangle` draws it for each.
/// @return  No volume for a triangle whose plane contains the light.
[[nodiscard]] VolumeGeometry volume_geometry(const scene::TriangleScene& triangles,
                                             const scene::Light& light,
                                             const methods::ShadowVolumes& volumes);

} // namespace gnomon::raster_gl
