#include "scene/case/space.hpp"

#include "scene/error.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::scene {

namespace {

using ObjectCorners = std::array<std::uint32_t, 3>;

/// An object's triangles, numbered within its own vertices.
struct MovedObject {
    std::vector<Vec3d> vertices;
    std::vector<ObjectCorners> triangles;
    std::vector<TriangleAttributes> attributes; ///< empty where the mesh has none
};

/// The attributes of a triangle's corners, in their order.
TriangleAttributes moved_attributes(TriangleAttributes corners, const CaseSpace& space)
{
    for (CornerAttributes& corner : corners) {
        // The axes are permutations of the mesh's, so nothing rounds.
        corner.normal = Vec3f{space.from_mesh(Vec3d{corner.normal}) / space.units_per_mesh_unit};
    }
    if (space.is_mirrored()) {
        std::swap(corners[1], corners[2]);
    }
    return corners;
}

/// @param number_of  [vertex of the mesh] work space, `no_triangle` everywhere before and after.
MovedObject moved_object(const TriangleScene& mesh, const Object& object, const CaseSpace& space,
                         std::vector<std::uint32_t>& number_of)
{
    MovedObject moved;
    std::vector<std::uint32_t> seen;
    for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
        ObjectCorners corners = mesh.triangles[object.first_triangle + t];
        for (std::uint32_t& corner : corners) {
            std::uint32_t& number = number_of[corner];
            if (number == no_triangle) {
                number = static_cast<std::uint32_t>(moved.vertices.size());
                moved.vertices.push_back(space.from_mesh(Vec3d{mesh.vertices[corner]}));
                seen.push_back(corner);
            }
            corner = number;
        }
        if (space.is_mirrored()) {
            std::swap(corners[1], corners[2]);
        }
        moved.triangles.push_back(corners);
        if (!mesh.attributes.empty()) {
            moved.attributes.push_back(
                moved_attributes(mesh.attributes[object.first_triangle + t], space));
        }
    }
    for (const std::uint32_t corner : seen) {
        number_of[corner] = no_triangle;
    }
    return moved;
}

/// Copies name, roles and counts of each object from the mesh; only its triangles may be fewer.
void keep_objects(const TriangleScene& mesh, TriangleScene& moved)
{
    for (Object& object : moved.objects) {
        Object own = *std::ranges::find(mesh.objects, object.name, &Object::name);
        own.first_triangle = object.first_triangle;
        own.triangle_count = object.triangle_count;
        own.flat_triangles = object.flat_triangles;
        object = std::move(own);
    }
}

} // namespace

bool CaseSpace::is_of_mesh() const
{
    return axes == CaseSpace{}.axes && units_per_mesh_unit == 1;
}

bool CaseSpace::is_mirrored() const
{
    // Odd permutations of three elements leave exactly one in its place.
    int in_place = 0;
    double sign = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        in_place += axes[i].of_mesh == static_cast<int>(i) ? 1 : 0;
        sign *= axes[i].sign;
    }
    return (in_place == 1 ? -sign : sign) < 0;
}

Vec3d CaseSpace::from_mesh(const Vec3d& point) const
{
    Vec3d result;
    for (int i = 0; i < 3; ++i) {
        const Axis& axis = axes[static_cast<std::size_t>(i)];
        result[i] = axis.sign * units_per_mesh_unit * point[axis.of_mesh];
    }
    return result;
}

Vec3d CaseSpace::up_of_mesh() const
{
    Vec3d up{0};
    for (int i = 0; i < 3; ++i) {
        const Axis& axis = axes[static_cast<std::size_t>(i)];
        up[i] = axis.of_mesh == 1 ? axis.sign : 0.0;
    }
    return up;
}

TriangleScene move_to_space(TriangleScene mesh, const CaseSpace& space)
{
    if (space.is_of_mesh()) {
        return mesh;
    }
    SceneBuilder builder;
    builder.count_ignored_primitives(mesh.ignored_primitives);
    builder.keep_contents(mesh.file);
    std::vector<std::uint32_t> number_of(mesh.vertices.size(), no_triangle);
    for (const Object& object : mesh.objects) {
        const MovedObject moved = moved_object(mesh, object, space, number_of);
        builder.add(object.name, moved.vertices, moved.triangles, moved.attributes);
    }
    TriangleScene result = builder.take();
    result.dropped_triangles += mesh.dropped_triangles;
    keep_objects(mesh, result);
    if (result.triangles.empty()) {
        throw InputError("mesh: in the renderer's units every triangle has zero area; correct "
                         "conventions.metres_per_unit");
    }
    return result;
}

} // namespace gnomon::scene
