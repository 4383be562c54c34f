#pragma once

#include "methods/passes.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::raster_gl {

/// Faces of shadow volumes whose windings count alike.
struct VolumeFaces {
    /// Caps: triangles of the scene, as their corners' indices.
    std::vector<std::array<std::uint32_t, 3>> caps;
    /// Sides: pairs of edges' ends, as indices of vertices; each is a quad (to, from, from at
    /// infinity, to at infinity).
    std::vector<std::array<std::uint32_t, 2>> sides;
};

/// The shadow volumes of a scene's casters: each caster's goes from itself away from the light to
/// infinity.
struct VolumeGeometry {
    VolumeFaces along;   ///< whose windings, as they are given, face out of the volume
    VolumeFaces against; ///< and into it
};

/// Which triangles cast is decided once for each, exactly. An edge that several casters share is
/// the same side in all their volumes: `silhouette` leaves it away where it faces out of as many as
/// it faces into, `triangle` draws it for each.
/// @return  Triangles whose plane holds the light have no volume.
[[nodiscard]] VolumeGeometry volume_geometry(const scene::TriangleScene& triangles,
                                             const scene::Light& light,
                                             const methods::ShadowVolumes& volumes);

} // namespace gnomon::raster_gl
