#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <array>

namespace gnomon::scene {

/// A renderer's coordinate system, relative to the mesh that it was given.
struct CaseSpace {
    /// An axis of the mesh, or its opposite.
    struct Axis {
        int of_mesh = 0; ///< 0 x, 1 y, 2 z
        double sign = 1; ///< 1 or −1

        friend bool operator==(const Axis&, const Axis&) = default;
    };

    std::array<Axis, 3> axes{{{0, 1}, {1, 1}, {2, 1}}}; ///< the renderer's x, y and z
    double units_per_mesh_unit = 1;
    double metres_per_unit = 1; ///< length of the renderer's unit

    /// Whether the mesh is already in the renderer's space.
    [[nodiscard]] bool is_of_mesh() const;
    /// Whether the axes mirror the mesh's.
    [[nodiscard]] bool is_mirrored() const;
    /// A point of the mesh, in the renderer's space [the renderer's units].
    [[nodiscard]] Vec3d from_mesh(const Vec3d& point) const;
    /// The mesh's up axis, y, in the renderer's space [1].
    [[nodiscard]] Vec3d up_of_mesh() const;
};

/// Moves the mesh to the renderer's space in double and rounds it to float32 once. Rotations,
/// mirroring and powers of two are exact. Triangles of a mirrored mesh keep their front faces.
/// @throws InputError  as `SceneBuilder::add`, and if no triangle is left.
[[nodiscard]] TriangleScene move_to_space(TriangleScene mesh, const CaseSpace& space);

} // namespace gnomon::scene
