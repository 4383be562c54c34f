#include "scene/geometry/vertex_normals.hpp"

#include "scene/fnv1a.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::scene {
namespace {

/// The normal, with twice the area as its length.
Vec3d area_vector_of(const TriangleScene& scene, std::uint32_t triangle)
{
    const auto [a, b, c] = scene.corners(triangle);
    const Vec3d origin{a};
    return glm::cross(Vec3d{b} - origin, Vec3d{c} - origin);
}

/// The faces at each vertex, side by side; objects share no vertices.
class FacesOfVertices {
public:
    explicit FacesOfVertices(const TriangleScene& scene)
        : first_(scene.vertices.size() + 1),
          faces_(3 * scene.triangles.size())
    {
        for (const auto& triangle : scene.triangles) {
            for (const std::uint32_t vertex : triangle) {
                ++first_[vertex + 1];
            }
        }
        for (std::size_t v = 1; v < first_.size(); ++v) {
            first_[v] += first_[v - 1];
        }
        std::vector<std::size_t> next{first_.begin(), first_.end() - 1};
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
            for (const std::uint32_t vertex : scene.triangles[t]) {
                faces_[next[vertex]++] = t;
            }
        }
    }

    [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t vertex) const
    {
        return std::span{faces_}.subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
    }

private:
    std::vector<std::size_t> first_; ///< [vertex] of its faces
    std::vector<std::uint32_t> faces_;
};

bool is_missing(const Vec3f& normal)
{
    return normal == Vec3f{0.0F};
}

/// The normal of one corner, from the faces at its vertex.
Vec3f creased_normal(const TriangleScene& scene, std::uint32_t own,
                     std::span<const std::uint32_t> faces)
{
    const double least_cosine = std::cos(glm::radians(crease_deg));
    const Vec3d own_normal = glm::normalize(area_vector_of(scene, own));
    Vec3d sum{0.0};
    for (const std::uint32_t face : faces) {
        const Vec3d area = area_vector_of(scene, face);
        if (face == own || glm::dot(area, own_normal) >= least_cosine * glm::length(area)) {
            sum += area;
        }
    }
    return Vec3f{glm::normalize(sum)};
}

} // namespace

void complete_vertex_normals(TriangleScene& scene)
{
    scene.attributes.resize(scene.triangles.size());
    const FacesOfVertices faces{scene};
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3f& normal = scene.attributes[t].at(k).normal;
            if (is_missing(normal)) {
                normal = creased_normal(scene, t, faces.at(scene.triangles[t].at(k)));
            }
        }
    }
}

Vec3f moved_normal(const glm::dmat3& to_other, const Vec3d& normal)
{
    const Vec3d x = to_other[0];
    const Vec3d y = to_other[1];
    const Vec3d z = to_other[2];
    const double side = glm::dot(x, glm::cross(y, z)) < 0 ? -1 : 1;
    const Vec3d moved = side * (normal.x * glm::cross(y, z) + normal.y * glm::cross(z, x) +
                                normal.z * glm::cross(x, y));
    const double length = glm::length(moved);
    // A rounded unit vector counts as unit, so that writing and reading it back does not change it.
    constexpr double rounding = 0x1p-22;
    if (std::abs(length - 1) <= rounding) {
        return Vec3f{moved};
    }
    return std::isfinite(length) && length > 0 ? Vec3f{moved / length} : Vec3f{0.0F};
}

std::string normals_hash(const TriangleScene& scene)
{
    if (scene.attributes.empty()) {
        return {};
    }
    Fnv1a hash;
    hash.add(scene.attributes.data(), scene.attributes.size() * sizeof(TriangleAttributes));
    return fmt::format("{:016x}", hash.value());
}

Vec3d vertex_normal_at(const TriangleScene& scene, std::uint32_t triangle, const Vec3d& point)
{
    const auto [a, b, c] = scene.corners(triangle);
    const Vec3d area = area_vector_of(scene, triangle);
    const auto& corners = scene.attributes[triangle];
    // Barycentric weights: the area opposite each corner over the whole area.
    const double of_a = glm::dot(glm::cross(Vec3d{b} - point, Vec3d{c} - point), area);
    const double of_b = glm::dot(glm::cross(Vec3d{c} - point, Vec3d{a} - point), area);
    const double of_c = glm::dot(glm::cross(Vec3d{a} - point, Vec3d{b} - point), area);
    const Vec3d sum = of_a * Vec3d{corners[0].normal} + of_b * Vec3d{corners[1].normal} +
                      of_c * Vec3d{corners[2].normal};
    const double length = glm::length(sum);
    if (!(length > 0)) {
        return glm::normalize(area);
    }
    return (glm::dot(sum, area) < 0 ? -1.0 : 1.0) / length * sum;
}

} // namespace gnomon::scene
