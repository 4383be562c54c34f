#include "compared.hpp"

#include "scene/job/file.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

/// The shadow of a box on the ground under a directional light is a polygon in closed form: the
/// convex hull of its projected corners.
namespace gnomon::tests {
namespace {

using scene::Vec2d;
using scene::Vec3d;

const Vec3d box_lower{-0.7, 0, -0.4};
const Vec3d box_upper{0.5, 1.1, 0.6};

double cross(const Vec2d& a, const Vec2d& b)
{
    return a.x * b.y - a.y * b.x;
}

/// Counter-clockwise, by Andrew's monotone chain.
std::vector<Vec2d> convex_hull(std::vector<Vec2d> points)
{
    std::sort(points.begin(), points.end(),
              [](const Vec2d& a, const Vec2d& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::vector<Vec2d> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const Vec2d& p : points) {
            while (hull.size() >= start + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) {
                hull.pop_back();
            }
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

bool is_inside(const std::vector<Vec2d>& hull, const Vec2d& p)
{
    for (std::size_t i = 0; i < hull.size(); ++i) {
        if (cross(hull[(i + 1) % hull.size()] - hull[i], p - hull[i]) < 0) {
            return false;
        }
    }
    return true;
}

std::vector<Vec2d> shadow_polygon(const Vec3d& direction)
{
    std::vector<Vec2d> points;
    for (const Vec3d& corner : scene::Box{box_lower, box_upper}.corners()) {
        const Vec3d rounded = scene::rounded_to_float32(corner);
        const Vec3d on_ground = rounded - rounded.y / direction.y * direction;
        points.emplace_back(on_ground.x, on_ground.z);
    }
    return convex_hull(points);
}

/// Writes box and ground as an OBJ file; returns its path.
std::filesystem::path write_scene(const std::filesystem::path& folder)
{
    auto path = folder / "box.obj";
    std::ofstream file{path};
    file << "o ground\nv -6 0 6\nv 6 0 6\nv 6 0 -6\nv -6 0 -6\nf 1 2 3 4\no box\n";
    for (const Vec3d& corner : scene::Box{box_lower, box_upper}.corners()) {
        file << fmt::format("v {} {} {}\n", corner.x, corner.y, corner.z);
    }
    file << "f 5 6 10 9\nf 5 9 11 7\nf 6 8 12 10\nf 7 11 12 8\nf 5 7 8 6\nf 9 10 12 11\n";
    return path;
}

/// Where the ray through (x, y), in pixels from the top left, meets the ground.
Vec2d ground_point(const scene::View& view, double x, double y)
{
    const scene::Camera& camera = view.camera;
    const double aspect = double(view.image.width_px) / view.image.height_px;
    const double sx = (2 * x / view.image.width_px - 1) * aspect * camera.half_height;
    const double sy = (1 - 2 * y / view.image.height_px) * camera.half_height;
    const Vec3d d = camera.forward + sx * camera.right + sy * camera.up;
    const Vec3d p = camera.eye - camera.eye.y / d.y * d;
    return {p.x, p.z};
}

/// Whether the polygon blocks a pixel. Empty within 10^-3 pixel of its border.
std::optional<bool> is_blocked(const std::vector<Vec2d>& polygon, const scene::View& view, int x,
                               int y)
{
    constexpr double border_px = 1e-3;
    const bool centre = is_inside(polygon, ground_point(view, x + 0.5, y + 0.5));
    for (const double dx : {-border_px, border_px}) {
        for (const double dy : {-border_px, border_px}) {
            if (is_inside(polygon, ground_point(view, x + 0.5 + dx, y + 0.5 + dy)) != centre) {
                return {};
            }
        }
    }
    return centre;
}

TEST(BoxShadow, EqualsItsPolygonPixelForPixel)
{
    GNOMON_REQUIRE_GL();
    const auto folder =
        std::filesystem::temp_directory_path() / fmt::format("gnomon_box_shadow_{}", ::getpid());
    std::filesystem::create_directories(folder);
    const auto path = write_scene(folder);
    for (const char* direction : {"[0.6, -1, 0.35]", "[-1.7, -1, 0.2]", "[0.05, -1, -0.9]"}) {
        const auto job = scene::read_job(path, {{"light.direction", direction},
                                                {"camera.eye", "[2.9, 3.3, 4.1]"},
                                                {"camera.target", "[0.2, 0.1, 0.3]"},
                                                {"image.width", "960"},
                                                {"image.height", "600"}})
                             .job;
        const Compared compared{job};
        const auto result = compared(job);
        const auto polygon = shadow_polygon(result.view.light.direction);
        std::array<std::size_t, 2> agreed{}; // lit, blocked
        std::size_t on_border = 0;
        for (int y = 0; y < 600; ++y) {
            for (int x = 0; x < 960; ++x) {
                const std::uint32_t t = result.receivers.triangle(x, y);
                const scene::PixelClass c = result.truth.pixel_class(x, y);
                if (t == scene::no_triangle || !scene::is_scored(c) ||
                    compared.file().scene.objects[compared.file().scene.object_of(t)].name !=
                        "ground") {
                    continue;
                }
                const auto expected = is_blocked(polygon, result.view, x, y);
                if (!expected) {
                    ++on_border;
                    continue;
                }
                ASSERT_EQ(c == scene::PixelClass::blocked, *expected)
                    << direction << " pixel " << x << ", " << y;
                ++agreed[*expected ? 1 : 0];
            }
        }
        EXPECT_GT(agreed[0], 50000U) << direction;
        EXPECT_GT(agreed[1], 2000U) << direction;
        EXPECT_LT(on_border, 100U) << direction;
    }
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace gnomon::tests
