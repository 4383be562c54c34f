#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <array>

namespace gnomon::scene {

/// Where the numbers of a renderer are, as seen from the mesh that it was given.
struct CaseSpace {
    /// An axis of the mesh, or its opposite.
    struct Axis {
        int of_mesh = 0; ///< 0 x, 1 y, 2 z
        double sign = 1; ///< 1 or −1

        friend bool operator==(const Axis&, const Axis&) = default;
    };

    std::array<Axis, 3> axes{{{0, 1}, {1, 1}, {2, 1}}}; ///< the renderer's x, y and z
    double units_per_mesh_unit = 1;
    double metres_per_unit = 1; ///< of the renderer

    /// True if the mesh is in the renderer's space already.
    [[nodiscard]] bool is_of_mesh() const;
    /// True if the axes are a mirror image of the mesh's.
    [[nodiscard]] bool is_mirrored() const;
    /// A point of the mesh, in the renderer's space [the renderer's units].
    [[nodiscard]] Vec3d from_mesh(const Vec3d& point) const;
    /// The mesh's y axis, which it calls up, in the renderer's space [1].
    [[nodiscard]] Vec3d up_of_mesh() const;
};

/// The mesh in the renderer's space: moved there in double, and rounded to float32 once. Turning,
/// mirroring and powers of two lose nothing. Triangles of a mirrored mesh keep their fronts.
/// @throws InputError  as `SceneBuilder::add` does, and if no triangle is left.
[[nodiscard]] TriangleScene move_to_space(TriangleScene mesh, const CaseSpace& space);

} // namespace gnomon::scene
