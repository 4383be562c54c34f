// Shadow volumes against the truth: correct except very close to a volume's side.

#include "compared.hpp"
#include "lane.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "raster_gl/shadow_volumes.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/camera/camera.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Label;
using scene::PixelClass;
using scene::Vec3d;

const std::vector<scene::Override> volumes{
    {"method.name", "shadow_volumes"}, {"image.width", "640"}, {"image.height", "360"}};

bool is_wrong(const analysis::Comparison& result, std::size_t pixel)
{
    const PixelClass truth = result.truth.pixel_class[pixel];
    return scene::is_scored(truth) &&
           scene::is_lit(result.lookup.samples[pixel].verdict) != (truth == PixelClass::lit);
}

/// Scored pixels with a scored neighbour (of four) of the opposite truth.
std::uint64_t pixels_beside_a_boundary(const analysis::Comparison& result)
{
    const auto& classes = result.truth.pixel_class;
    const auto [width, height] = classes.size();
    const auto differs = [&](int x, int y, PixelClass own) {
        return x >= 0 && y >= 0 && x < width && y < height && scene::is_scored(classes(x, y)) &&
               classes(x, y) != own;
    };
    std::uint64_t count = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const PixelClass own = classes(x, y);
            count += scene::is_scored(own) && (differs(x - 1, y, own) || differs(x + 1, y, own) ||
                                               differs(x, y - 1, own) || differs(x, y + 1, own))
                         ? 1U
                         : 0U;
        }
    }
    return count;
}

/// Where the sides of volumes meet the surfaces that pixels show, in the image.
class SidesInImage {
public:
    SidesInImage(const scene::TriangleScene& triangles, const scene::View& view,
                 const methods::ShadowVolumes& of)
        : triangles_{triangles},
          view_{view}
    {
        const auto made = raster_gl::volume_geometry(triangles, view.light, of);
        for (const auto* faces : {&made.along, &made.against}) {
            sides_.insert(sides_.end(), faces->sides.begin(), faces->sides.end());
        }
    }

    /// Distance from the pixel's centre to the nearest line where a side that passes its point
    /// meets the plane of its triangle [px].
    [[nodiscard]] double distance_px(int x, int y, std::uint32_t triangle) const
    {
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& [from, to] : sides_) {
            const Vec3d u{triangles_.vertices[from]};
            const Vec3d v{triangles_.vertices[to]};
            nearest = std::min(nearest, distance_px(x, y, triangle, u, v));
        }
        return nearest;
    }

private:
    /// The vector from the light to a point, or the light's direction.
    [[nodiscard]] Vec3d from_light(const Vec3d& point) const
    {
        return view_.light.has_position() ? point - view_.light.position : view_.light.direction;
    }
    [[nodiscard]] Vec3d point(double x, double y, std::uint32_t triangle) const
    {
        const auto corners = triangles_.corners(triangle);
        const Vec3d a{corners[0]};
        const Vec3d normal = glm::cross(Vec3d{corners[1]} - a, Vec3d{corners[2]} - a);
        const scene::Ray ray = ray_at(x, y);
        return ray.origin +
               ray.direction * (glm::dot(normal, a - ray.origin) / glm::dot(normal, ray.direction));
    }
    /// The ray through an image point [px]; `pixel_ray` for arbitrary points.
    [[nodiscard]] scene::Ray ray_at(double x, double y) const
    {
        const scene::Camera& camera = view_.camera;
        const double width = view_.image.width_px;
        const double height = view_.image.height_px;
        const double sx = (2 * x / width - 1) * width / height * camera.half_height;
        const double sy = (1 - 2 * y / height) * camera.half_height;
        const Vec3d aside = sx * camera.right + sy * camera.up;
        return camera.projection == scene::Projection::perspective
                   ? scene::Ray{camera.eye, camera.forward + aside}
                   : scene::Ray{camera.eye + aside, camera.forward};
    }
    [[nodiscard]] double distance_px(int x, int y, std::uint32_t triangle, const Vec3d& u,
                                     const Vec3d& v) const
    {
        const Vec3d of_u = from_light(u);
        const Vec3d of_v = from_light(v);
        const Vec3d side =
            view_.light.has_position() ? glm::cross(of_u, of_v) : glm::cross(of_u, v - u);
        const auto beyond_side = [&](double px, double py) {
            return glm::dot(glm::normalize(side), point(px, py, triangle) - u);
        };
        const double at_x = x + 0.5;
        const double at_y = y + 0.5;
        if (!leads_past(point(at_x, at_y, triangle), u, v, side)) {
            return std::numeric_limits<double>::infinity();
        }
        // The side's distance is a quotient of linear functions of the image position, nearly
        // linear within a hundredth of a pixel.
        constexpr double step = 0.01;
        const double here = beyond_side(at_x, at_y);
        const double along_x = (beyond_side(at_x + step, at_y) - here) / step;
        const double along_y = (beyond_side(at_x, at_y + step) - here) / step;
        return std::abs(here) / std::hypot(along_x, along_y);
    }
    /// Whether, seen from the light, the point is beside the edge from u to v: with a tenth of its
    /// length to spare.
    [[nodiscard]] bool leads_past(const Vec3d& at, const Vec3d& u, const Vec3d& v,
                                  const Vec3d& side) const
    {
        const Vec3d across_u = glm::cross(side, from_light(u));
        const Vec3d across_v = glm::cross(side, from_light(v));
        const Vec3d of_point = view_.light.has_position() ? from_light(at) : at - u;
        const Vec3d to_v = view_.light.has_position() ? from_light(v) : v - u;
        const Vec3d to_u = view_.light.has_position() ? from_light(u) : v - u;
        const double length = glm::dot(across_u, to_v);
        const double part = glm::dot(across_u, of_point) / length;
        if (!view_.light.has_position()) {
            return part > -0.1 && part < 1.1;
        }
        const double back = glm::dot(across_v, of_point) / glm::dot(across_v, to_u);
        return part > -0.1 * std::abs(back) && back > -0.1 * std::abs(part);
    }

    const scene::TriangleScene& triangles_;
    const scene::View& view_;
    std::vector<std::array<std::uint32_t, 2>> sides_;
};

methods::ShadowVolumes volumes_of(const scene::Job& job)
{
    return methods::passes(job).volumes.value();
}

/// Every wrong pixel is within 1/64 of a pixel of a volume's side.
void expect_errors_at_sides(const analysis::Comparison& result)
{
    const SidesInImage sides{*result.triangles, result.view, volumes_of(result.job)};
    const auto [width, height] = result.view.image;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x);
            if (is_wrong(result, pixel)) {
                EXPECT_LE(sides.distance_px(x, y, result.receivers.triangle[pixel]), 1 / 64.0)
                    << "pixel " << x << ", " << y;
            }
        }
    }
}

TEST(ShadowVolumes, AreRightOnTheLessonsScenes)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin : {"sphere-cube", "sphere-plane", "room", "playground"}) {
        for (const char* const extrusion : {"silhouette", "triangle"}) {
            SCOPED_TRACE(fmt::format("{} {}", builtin, extrusion));
            const scene::Job job =
                job_of_builtin(builtin, with(volumes, {{"method.extrusion", extrusion}}));
            const Compared scene{job};
            const auto result = scene(job);
            const std::uint64_t wrong = result.metrics.false_shadow + result.metrics.false_lit;
            EXPECT_LE(static_cast<double>(wrong),
                      1e-4 * static_cast<double>(result.metrics.pixels.scored()));
            EXPECT_GT(result.metrics.pixels.of(PixelClass::blocked), 1000U);
            expect_errors_at_sides(result);
            EXPECT_EQ(result.diagnosis->causes.counts.of(Cause::precision), wrong);
        }
    }
}

TEST(ShadowVolumes, AreWrongAtTheirSidesAlone)
{
    GNOMON_REQUIRE_GL();
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        SCOPED_TRACE(builtin.name);
        const scene::Job job = job_of_builtin(builtin.name, volumes);
        const Compared scene{job};
        if (!runs_full_tests() && scene.file().scene.triangles.size() > 20'000) {
            continue;
        }
        const auto result = scene(job);
        const std::uint64_t wrong = result.metrics.false_shadow + result.metrics.false_lit;
        EXPECT_LE(static_cast<double>(wrong),
                  0.01 * static_cast<double>(pixels_beside_a_boundary(result)));
        expect_errors_at_sides(result);
    }
}

/// Random cameras of both kinds with lights of all kinds.
scene::Job random_view(std::mt19937& random)
{
    std::uniform_real_distribution<double> around{-4, 4};
    std::uniform_real_distribution<double> above{0.5, 5};
    const auto place = [&] { return Vec3d{around(random), above(random), around(random)}; };
    scene::Job job = job_of_builtin(
        "sphere-cube", with(volumes, {{"image.width", "200"}, {"image.height", "150"}}));
    job.camera = scene::CameraSettings{};
    job.camera->eye = place();
    job.camera->target = {around(random) / 8, 0.5, around(random) / 8};
    if (random() % 2 == 0) {
        job.camera->projection = scene::Projection::orthographic;
        job.camera->orthographic_height_m = 6;
    }
    job.light = scene::LightSettings{};
    job.light->type =
        std::array{scene::LightType::directional, scene::LightType::spot, scene::LightType::point}
            .at(random() % 3);
    if (job.light->type == scene::LightType::directional) {
        job.light->direction = -place();
    } else {
        job.light->position = place();
    }
    if (job.light->type == scene::LightType::spot) {
        job.light->target = Vec3d{0, 0.5, 0};
        job.light->cone_deg = 100;
    }
    job.shadow_map.layout.reset();
    return job;
}

TEST(ShadowVolumes, HoldFromAnywhereBeforeAnyLight)
{
    GNOMON_REQUIRE_GL();
    std::mt19937 random{2604};
    const Compared scene{job_of_builtin("sphere-cube", volumes)};
    std::uint64_t scored = 0;
    std::uint64_t blocked = 0;
    for (int i = 0; i < 24; ++i) {
        const scene::Job job = random_view(random);
        SCOPED_TRACE(fmt::format("view {}: {} camera, {} light", i,
                                 projection_name(job.camera->projection),
                                 light_type_name(job.light->type)));
        const auto result = scene(job);
        scored += result.metrics.pixels.scored();
        blocked += result.metrics.pixels.of(PixelClass::blocked);
        expect_errors_at_sides(result);
    }
    EXPECT_GT(scored, 50'000U);
    EXPECT_GT(blocked, 5'000U);
}

/// All of an orthographic camera's rays leave the scene along `forward`, beside or along edges of
/// volumes.
TEST(ShadowVolumes, HoldWhereParallelRaysLeaveAlongTheLights)
{
    GNOMON_REQUIRE_GL();
    const auto from_above = [](const char* builtin, const char* light, const char* eye) {
        const scene::Job job =
            job_of_builtin(builtin, with(volumes, {{"image.width", "160"},
                                                   {"image.height", "90"},
                                                   {"light.type", "point"},
                                                   {"light.position", light},
                                                   {"camera.eye", eye},
                                                   {"camera.target", "[0, 0, 0]"},
                                                   {"camera.up", "[0, 0, -1]"},
                                                   {"camera.orthographic_height", "8"}}));
        const Compared scene{job};
        const auto result = scene(job);
        EXPECT_GT(result.metrics.pixels.scored(), 300U);
        expect_errors_at_sides(result);
    };
    from_above("sphere-plane", "[0, 6, 0]", "[0, 12, 0]");
    from_above("sphere-plane", "[1, 6, 0]", "[0, 12, 0]");
    from_above("sphere-plane", "[1, 9, 0.5]", "[1, 9, 0.5]");
    from_above("sphere-cube", "[0, 6, 0]", "[0, 12, 0]");
}

TEST(ShadowVolumes, OfAClosedMeshAroundTheLightNeedAllCasters)
{
    GNOMON_REQUIRE_GL();
    const auto of = [](const char* casters) {
        const scene::Job job = job_of_builtin(
            "sphere-cube", with(volumes, {{"method.casters", casters},
                                          {"light.type", "point"},
                                          {"light.position", "[0, 0, 0]"}})); // in the cube
        const Compared scene{job};
        return scene(job);
    };
    const auto lost = of("facing_light");
    EXPECT_GT(lost.metrics.false_lit, 0U);
    EXPECT_EQ(lost.diagnosis->causes.counts.of(Cause::coverage), lost.metrics.false_lit);
    EXPECT_EQ(of("all").metrics.false_lit, 0U);
}

TEST(ShadowVolumes, OfOpenMeshesNeedAllCasters)
{
    GNOMON_REQUIRE_GL();
    scene::SceneFile file = plates_over_ground({{-2, 1, -2, 1, 2}});
    scene::Job job = looking_down(job_of_builtin("wall", {{"method.name", "shadow_volumes"}}));
    const auto wrong_with = [&](const char* casters, bool turned) {
        scene::SceneFile one = file;
        for (std::size_t t = 2; turned && t < 4; ++t) { // the ground's two come first
            std::swap(one.scene.triangles[t][0], one.scene.triangles[t][1]);
        }
        scene::Job of_casters = job;
        of_casters.method.values["method.casters"] = std::string{casters};
        const Compared scene{std::move(one)};
        return scene(of_casters);
    };
    for (const bool turned : {false, true}) {
        EXPECT_EQ(wrong_with("all", turned).metrics.false_lit, 0U);
    }
    EXPECT_EQ(wrong_with("facing_light", false).metrics.false_lit, 0U);
    const auto lost = wrong_with("facing_light", true);
    const std::uint64_t blocked = lost.metrics.pixels.of(PixelClass::blocked);
    EXPECT_GT(blocked, 2000U); // 3 × 3 m of 8 × 8 m, in 128 × 128 pixels: 2304
    EXPECT_EQ(lost.metrics.false_lit, blocked);
    EXPECT_EQ(lost.diagnosis->causes.counts.of(Cause::coverage), blocked);
    EXPECT_EQ(lost.diagnosis->causes.counts.of(Label::leak), blocked);
}

TEST(ShadowVolumes, HaveSidesWhereSilhouettesAre)
{
    // A closed cube before a lamp that sees three of its faces: of its 12 edges and 6 diagonals the
    // 6 around those faces are silhouettes, each with two casters' sides.
    const scene::Job job = job_of_builtin("sphere-cube", volumes);
    const Compared scene{job};
    scene::SceneFile file = scene::load_scene(job.scene);
    const auto& objects = file.scene.objects;
    const auto cube = std::ranges::find(objects, "cube", &scene::Object::name);
    ASSERT_NE(cube, objects.end());
    scene::TriangleScene alone;
    alone.vertices = file.scene.vertices;
    alone.triangles.assign(file.scene.triangles.begin() + cube->first_triangle,
                           file.scene.triangles.begin() + cube->first_triangle +
                               cube->triangle_count);
    alone.objects = {{"cube", 0, cube->triangle_count, true, true}};
    ASSERT_EQ(alone.triangles.size(), 12U);
    const scene::Light lamp{.type = scene::LightType::point, .position = {20, 30, 25}};
    const auto sides_of = [&](methods::Extrusion extrusion, methods::Casters casters) {
        const auto made = raster_gl::volume_geometry(alone, lamp, {extrusion, casters});
        return made.along.sides.size() + made.against.sides.size();
    };
    using methods::Casters;
    using methods::Extrusion;
    EXPECT_EQ(sides_of(Extrusion::silhouette, Casters::facing_light), 6U);
    EXPECT_EQ(sides_of(Extrusion::silhouette, Casters::all), 12U);
    EXPECT_EQ(sides_of(Extrusion::triangle, Casters::facing_light), 18U);
    EXPECT_EQ(sides_of(Extrusion::triangle, Casters::all), 36U);
}

} // namespace
} // namespace gnomon::tests
