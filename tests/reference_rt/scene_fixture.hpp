#pragma once

#include "reference_rt/truth.hpp"
#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

/// Small scenes, and GL's receivers in them by brute force.
namespace gnomon::reference_rt::test {

using scene::Image;
using scene::ImageSize;
using scene::no_triangle;
using scene::PixelClass;
using scene::SceneBuilder;
using scene::TriangleScene;
using scene::Vec2d;
using scene::Vec3d;
using scene::View;

/// A square of n × n cells, two triangles each, on the plane y = height, facing up.
inline void add_ground(SceneBuilder& builder, double half_side, int n, double height = 0,
                       std::string_view name = "ground")
{
    std::vector<Vec3d> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto index = [&](int i, int k) { return static_cast<std::uint32_t>(i * (n + 1) + k); };
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= n; ++k) {
            vertices.emplace_back(half_side * (2.0 * i / n - 1), height,
                                  half_side * (2.0 * k / n - 1));
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            triangles.push_back({index(i, k), index(i, k + 1), index(i + 1, k + 1)});
            triangles.push_back({index(i, k), index(i + 1, k + 1), index(i + 1, k)});
        }
    }
    builder.add(name, vertices, triangles);
}

/// A ground at y = 0 and a plate of two triangles at y = 1, x and z from −1/3 to 1.
inline TriangleScene plate_over_ground()
{
    SceneBuilder builder;
    add_ground(builder, 4, 1);
    const double third = 1.0 / 3;
    builder.add("plate",
                std::vector<Vec3d>{{-third, 1, -third}, {-third, 1, 1}, {1, 1, 1}, {1, 1, -third}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
    return builder.take();
}

/// A closed box, faces counter-clockwise from outside.
inline void add_box(SceneBuilder& builder, const Vec3d& lower, const Vec3d& upper,
                    std::string_view name = "box")
{
    std::vector<Vec3d> corners;
    for (unsigned i = 0; i < 8; ++i) {
        corners.emplace_back((i & 1U) != 0 ? upper.x : lower.x, (i & 2U) != 0 ? upper.y : lower.y,
                             (i & 4U) != 0 ? upper.z : lower.z);
    }
    builder.add(name, corners,
                std::vector<std::array<std::uint32_t, 3>>{{0, 2, 3},
                                                          {0, 3, 1},
                                                          {4, 5, 7},
                                                          {4, 7, 6},
                                                          {0, 1, 5},
                                                          {0, 5, 4},
                                                          {2, 6, 7},
                                                          {2, 7, 3},
                                                          {0, 4, 6},
                                                          {0, 6, 2},
                                                          {1, 3, 7},
                                                          {1, 7, 5}});
}

/// A closed sphere of 2·n·(n − 1)·2 triangles with poles along y.
inline void add_sphere(SceneBuilder& builder, const Vec3d& centre, double radius, int n)
{
    std::vector<Vec3d> vertices{centre + Vec3d{0, radius, 0}};
    const int columns = 2 * n;
    for (int i = 1; i < n; ++i) {
        for (int k = 0; k < columns; ++k) {
            const double polar = std::numbers::pi * i / n;
            const double azimuth = 2 * std::numbers::pi * k / columns;
            vertices.push_back(centre + radius * Vec3d{std::sin(polar) * std::cos(azimuth),
                                                       std::cos(polar),
                                                       std::sin(polar) * std::sin(azimuth)});
        }
    }
    vertices.push_back(centre - Vec3d{0, radius, 0});
    const auto last = static_cast<std::uint32_t>(vertices.size() - 1);
    const auto index = [&](int i, int k) {
        return static_cast<std::uint32_t>(1 + (i - 1) * columns + k % columns);
    };
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (int k = 0; k < columns; ++k) {
        triangles.push_back({0, index(1, k + 1), index(1, k)});
        for (int i = 1; i + 1 < n; ++i) {
            triangles.push_back({index(i, k), index(i, k + 1), index(i + 1, k + 1)});
            triangles.push_back({index(i, k), index(i + 1, k + 1), index(i + 1, k)});
        }
        triangles.push_back({last, index(n - 1, k), index(n - 1, k + 1)});
    }
    builder.add("sphere", vertices, triangles);
}

inline View make_view(const Vec3d& eye, const Vec3d& target, ImageSize image,
                      const scene::LightSettings& light,
                      scene::Projection projection = scene::Projection::perspective)
{
    scene::CameraSettings camera;
    camera.eye = eye;
    camera.target = target;
    camera.projection = projection;
    return View{scene::make_camera(camera), image, scene::make_light(light), {}, {}};
}

inline scene::LightSettings directional(const Vec3d& direction)
{
    scene::LightSettings light;
    light.direction = direction;
    return light;
}

inline scene::LightSettings spot(const Vec3d& position, const Vec3d& target, double cone_deg)
{
    scene::LightSettings light;
    light.type = scene::LightType::spot;
    light.position = position;
    light.target = target;
    light.cone_deg = cone_deg;
    return light;
}

/// The triangle that each pixel's ray meets first, by trying all of them in double (Möller and
/// Trumbore's formula, which the reference does not use).
inline Image<std::uint32_t> brute_force_receivers(const TriangleScene& scene, const View& view)
{
    Image<std::uint32_t> result{view.image, no_triangle};
    const double near_m = scene::receiver_near_m(scene.bounds());
    const auto ranges = scene::receiving_ranges(scene);
    for (int y = 0; y < view.image.height_px; ++y) {
        for (int x = 0; x < view.image.width_px; ++x) {
            const scene::Ray ray = scene::pixel_ray(view.camera, view.image, x, y);
            double nearest = std::numeric_limits<double>::infinity();
            for (const auto& range : ranges) {
                for (std::uint32_t t = range.first; t < range.first + range.count; ++t) {
                    const auto corner = scene.corners(t);
                    const Vec3d a{corner[0]};
                    const Vec3d e1 = Vec3d{corner[1]} - a;
                    const Vec3d e2 = Vec3d{corner[2]} - a;
                    const Vec3d p = glm::cross(ray.direction, e2);
                    const double determinant = glm::dot(e1, p);
                    const Vec3d s = ray.origin - a;
                    const double u = glm::dot(s, p) / determinant;
                    if (!(u >= 0 && u <= 1)) {
                        continue;
                    }
                    const Vec3d q = glm::cross(s, e1);
                    const double v = glm::dot(ray.direction, q) / determinant;
                    const double distance = glm::dot(e2, q) / determinant;
                    if (v >= 0 && u + v <= 1 && distance > near_m && distance < nearest) {
                        nearest = distance;
                        result(x, y) = t;
                    }
                }
            }
        }
    }
    return result;
}

/// The truth for brute-force receivers.
inline scene::Truth truth_of(const TriangleScene& scene, const View& view,
                             const TruthOptions& options = {})
{
    const bool is_plain = options.method == TruthMethod::plain;
    return compute_truth(ReferenceScene{scene, {0, !is_plain, is_plain}}, view,
                         brute_force_receivers(scene, view), {}, options);
}

template <typename Value>
[[nodiscard]] int count(const Image<Value>& image, Value value)
{
    int result = 0;
    for (const Value& pixel : image) {
        result += pixel == value ? 1 : 0;
    }
    return result;
}

} // namespace gnomon::reference_rt::test
