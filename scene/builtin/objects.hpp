#pragma once

#include "scene/vec.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::scene {

/// A generated object that is not yet part of a scene.
///
/// Triangles are counter-clockwise seen from outside. The parts of a solid share corners by index,
/// so a closed solid stays closed after rounding to float32.
struct Mesh {
    std::vector<Vec3d> vertices; ///< [m]
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Two triangles; the side from which a, b, c, d run counter-clockwise is the outside.
[[nodiscard]] Mesh make_quad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

/// A level square or rectangle at height `y_m`, facing up.
/// @param lower  Its corner of smallest (x, z) [m].
/// @param upper  Its corner of largest (x, z) [m]; greater than `lower` in both.
[[nodiscard]] Mesh make_ground(const Vec2d& lower, const Vec2d& upper, double y_m = 0);

/// A closed axis-aligned box of 8 corners and 12 triangles; `lower` < `upper` in each coordinate.
[[nodiscard]] Mesh make_box(const Vec3d& lower, const Vec3d& upper);

/// The closed solid that a profile sweeps when it turns about the y axis.
///
/// @param profile  (radius, y) [m] from the lowest point to the highest; the first and the last lie
///                 on the axis (radius 0), the others off it; at least three.
/// @param slices   Segments around the axis; at least 3.
/// @return  2 · slices · (profile.size() − 2) triangles.
[[nodiscard]] Mesh make_revolution(std::span<const Vec2d> profile, int slices);

/// A sphere of latitudes and longitudes: 2 · slices · (stacks − 1) triangles.
[[nodiscard]] Mesh make_sphere(const Vec3d& centre, double radius_m, int slices, int stacks);

/// A closed upright cylinder on `base`: 4 · slices triangles.
[[nodiscard]] Mesh make_cylinder(const Vec3d& base, double radius_m, double height_m, int slices);

/// The closed prism over a simple polygon in the xy plane, from z = `lower_z_m` to `upper_z_m`.
/// @param outline  (x, y) [m], counter-clockwise seen from +z.
[[nodiscard]] Mesh make_prism(std::span<const Vec2d> outline, double lower_z_m, double upper_z_m);

/// The shape of a wall on round arches, centred on x = 0.
struct ArcadeShape {
    int arch_count = 7;         ///< at least 1
    double spacing_m = 3;       ///< from the middle of one pier to the next
    double arch_radius_m = 1.2; ///< less than half the spacing
    double springing_y_m = 0;   ///< where the arches start: the piers' feet
    double top_y_m = 2;         ///< above springing_y_m + arch_radius_m
    int arch_segments = 24;     ///< at least 2
};
/// The corners (x, y) [m] of its outline, counter-clockwise from the lower left one.
[[nodiscard]] std::vector<Vec2d> arcade_outline(const ArcadeShape& shape);

void move_by(Mesh& mesh, const Vec3d& offset_m);
/// Turns by a quarter about the y axis, exactly: x → −z, z → x.
void turn_quarter(Mesh& mesh);
/// Turns about the y axis, from z towards x.
void turn_about_y(Mesh& mesh, double angle_rad);
/// Turns the outside in.
void flip(Mesh& mesh);
/// Adds `part` as a separate piece of `whole`.
void append(Mesh& whole, const Mesh& part);

} // namespace gnomon::scene
