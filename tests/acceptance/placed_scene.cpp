#include "placed_scene.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace gnomon::tests {
namespace {

using scene::Vec3d;

/// x ↦ scale·x + shift.
struct Move {
    double scale = 1;
    Vec3d shift{0};

    void point(Vec3d& x) const { x = scale * x + shift; }
    void point(std::optional<Vec3d>& x) const
    {
        if (x) {
            point(*x);
        }
    }
    void length(double& x) const { x *= scale; }
    void length(std::optional<double>& x) const
    {
        if (x) {
            length(*x);
        }
    }
};

void move(const Move& by, scene::CameraSettings& camera)
{
    by.point(camera.eye);
    by.point(camera.target);
    by.length(camera.orthographic_height_m);
}

void move(const Move& by, scene::LightSettings& light)
{
    by.point(light.position); // moving both keeps a sun's direction
    by.point(light.target);
}

void move(const Move& by, scene::Job& job)
{
    if (job.camera) {
        move(by, *job.camera);
    }
    if (job.light) {
        move(by, *job.light);
    }
    by.length(job.shadow_map.frustum.half_extent_m);
    by.length(job.shadow_map.frustum.near_m);
    by.length(job.shadow_map.frustum.far_m);
    by.length(job.bias.constant_m);
}

scene::TriangleScene moved(const Move& by, const scene::TriangleScene& scene)
{
    scene::SceneBuilder builder;
    for (const scene::Object& object : scene.objects) {
        std::vector<std::array<std::uint32_t, 3>> triangles(
            scene.triangles.begin() + object.first_triangle,
            scene.triangles.begin() + object.first_triangle + object.triangle_count);
        std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
        std::uint32_t last = 0;
        for (const auto& corners : triangles) {
            first = std::min(first, std::ranges::min(corners));
            last = std::max(last, std::ranges::max(corners));
        }
        std::vector<Vec3d> vertices;
        for (std::uint32_t i = first; i <= last; ++i) {
            vertices.emplace_back(scene.vertices[i]);
            by.point(vertices.back());
        }
        for (auto& corners : triangles) {
            for (std::uint32_t& corner : corners) {
                corner -= first;
            }
        }
        builder.add(object.name, vertices, triangles);
    }
    return builder.take();
}

} // namespace

Placed place(const scene::Job& job, const scene::SceneFile& file, const Placement& placement)
{
    const double step_m =
        placement.diagonals * placement.scale * file.scene.bounds().diagonal_m() / 3;
    const Move by{placement.scale, step_m * Vec3d{2, -2, 1}};
    Placed placed{job, {moved(by, file.scene), file.defaults}};
    move(by, placed.job);
    if (placed.file.defaults.camera) {
        move(by, *placed.file.defaults.camera);
    }
    if (placed.file.defaults.light) {
        move(by, *placed.file.defaults.light);
    }
    scene::set_roles(placed.file.scene, job.scene.no_cast, job.scene.no_receive);
    return placed;
}

} // namespace gnomon::tests
