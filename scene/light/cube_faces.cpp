#include "scene/light/cube_faces.hpp"

#include "scene/light/near_far.hpp"

#include <glm/common.hpp>

#include <algorithm>

namespace gnomon::scene {
namespace {

Vec3d vector_along(const WorldAxis& axis)
{
    return {axis[0], axis[1], axis[2]};
}

LightFrustum face_of(const CubeFace& face, const FrustumSettings& settings, const Vec3d& origin)
{
    LightFrustum frustum; // its sides, ±1 at ζ = 1, are those of 90°
    frustum.projection = Projection::perspective;
    frustum.content = settings.content;
    frustum.origin = origin;
    frustum.forward = vector_along(face.forward);
    frustum.right = vector_along(face.right);
    frustum.up = vector_along(face.up);
    frustum.reversed = settings.reversed;
    frustum.clip_range = clip_range_of(settings);
    return frustum;
}

/// Largest ζ of a vertex, on whatever face it lies [m].
double farthest_vertex_m(const TriangleScene& scene, const Vec3d& origin)
{
    double farthest = 0;
    for (const Vec3f& vertex : scene.vertices) {
        const Vec3d way = glm::abs(Vec3d{vertex} - origin);
        farthest = std::max({farthest, way.x, way.y, way.z});
    }
    return farthest;
}

} // namespace

std::size_t cube_face_towards(const Vec3f& direction)
{
    const std::array<float, cube_face_count> components{direction.x,  -direction.x, direction.y,
                                                        -direction.y, direction.z,  -direction.z};
    return static_cast<std::size_t>(
        std::distance(components.begin(), std::ranges::max_element(components)));
}

std::vector<LightFrustum> fit_cube_faces(const FrustumSettings& settings, const Light& light,
                                         const TriangleScene& scene)
{
    std::vector<LightFrustum> faces;
    for (const CubeFace& face : cube_faces) {
        faces.push_back(face_of(face, settings, light.position));
    }
    const double smallest_m = smallest_relative_extent * scene.bounds().diagonal_m();
    LightDistanceRange range{0, farthest_vertex_m(scene, light.position)};
    widen(range.nearest_m, range.farthest_m, smallest_m);
    set_near_far(faces, settings, scene, {range, false, smallest_m});
    make_room_for_distances(faces, settings, scene);
    for (LightFrustum& face : faces) {
        compose_matrix(face);
    }
    return faces;
}

} // namespace gnomon::scene
