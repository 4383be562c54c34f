#include "lane.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/error.hpp"
#include "scene/view/view.hpp"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace gnomon::scene {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

[[nodiscard]] TriangleScene build(const BuiltinScene& builtin, const ParameterValues& given = {})
{
    return builtin.build(complete_parameters(builtin, given));
}

[[nodiscard]] Job job_of(const BuiltinScene& builtin, const ParameterValues& given = {})
{
    return builtin.default_job(complete_parameters(builtin, given));
}

[[nodiscard]] std::string refusal(const std::string& scene, const ParameterValues& given)
{
    try {
        (void)complete_parameters(find_builtin_scene(scene), given);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

/// Nearest hit of a ray by Möller and Trumbore in double; accurate enough away from edges.
[[nodiscard]] double nearest_hit(const TriangleScene& scene, const Ray& ray, double from)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const auto corners = scene.corners(i);
        const Vec3d a{corners[0]};
        const Vec3d e1 = Vec3d{corners[1]} - a;
        const Vec3d e2 = Vec3d{corners[2]} - a;
        const Vec3d p = glm::cross(ray.direction, e2);
        const double det = glm::dot(e1, p);
        const Vec3d q = glm::cross(ray.origin - a, e1);
        const double u = glm::dot(ray.origin - a, p) / det;
        const double v = glm::dot(ray.direction, q) / det;
        const double t = glm::dot(e2, q) / det;
        if (u >= 0 && v >= 0 && u + v <= 1 && t > from) {
            nearest = std::min(nearest, t);
        }
    }
    return nearest;
}

/// Calls `visit(P)` for the points seen by 32×18 pixels; infinite where a pixel sees nothing.
template <typename Visit>
void visit_view(const Job& job, const TriangleScene& scene, const Visit& visit)
{
    const View view = resolve_view(job, scene, {});
    for (int y = 20; y < job.image.height_px; y += 40) {
        for (int x = 20; x < job.image.width_px; x += 40) {
            const Ray ray = pixel_ray(view.camera, job.image, x, y);
            visit(ray.origin + nearest_hit(scene, ray, 0) * ray.direction, view);
        }
    }
}

TEST(BuiltinScenes, AreTheThirteenInOrder)
{
    std::vector<std::string> names;
    for (const BuiltinScene& builtin : builtin_scenes()) {
        names.push_back(builtin.name);
        EXPECT_FALSE(builtin.description.empty()) << builtin.name;
        EXPECT_EQ(builtin.description.find('\n'), std::string::npos) << builtin.name;
        EXPECT_FALSE(builtin.origin.empty()) << builtin.name;
    }
    EXPECT_THAT(names, ElementsAre("sphere-cube", "sphere-plane", "yard", "playground",
                                   "two-distances", "tilted-plane", "wall", "room", "lamp-room",
                                   "fence", "terrain", "columns", "sphere-field"));
}

TEST(BuiltinScenes, BuildTheSameBitsTwice)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        EXPECT_EQ(content_hash(build(builtin)), content_hash(build(builtin))) << builtin.name;
    }
}

TEST(BuiltinScenes, BuildAtBothEndsOfEveryParameter)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        for (const BuiltinParameter& parameter : builtin.parameters) {
            std::vector<SceneParameter> ends{parameter.lower, parameter.upper};
            if (!parameter.words.empty()) {
                ends.assign(parameter.words.begin(), parameter.words.end());
            } else if (!tests::runs_full_tests() && parameter.name == "cells") {
                ends.pop_back(); // the usual lane leaves out two million triangles
            }
            for (const SceneParameter& end : ends) {
                const ParameterValues given{{parameter.name, end}};
                const TriangleScene scene = build(builtin, given);
                EXPECT_EQ(scene.dropped_triangles, 0U) << builtin.name << " " << parameter.name;
                EXPECT_NO_THROW((void)resolve_view(job_of(builtin, given), scene, {}))
                    << builtin.name << " " << parameter.name;
            }
        }
    }
}

TEST(BuiltinScenes, DefaultJobsSeeTheScene)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        const TriangleScene scene = build(builtin);
        const Job job = job_of(builtin);
        ASSERT_TRUE(job.camera && job.light) << builtin.name;
        const View view = resolve_view(job, scene, {});
        EXPECT_LT(view.first_map().near_m, view.first_map().far_m) << builtin.name;
        const Vec3d towards = scene.bounds().centre() - view.camera.eye;
        const double depth = glm::dot(towards, view.camera.forward);
        const double half_height = view.camera.half_height * depth;
        const double aspect = static_cast<double>(job.image.width_px) / job.image.height_px;
        EXPECT_GT(depth, 0.0) << builtin.name;
        EXPECT_LT(std::abs(glm::dot(towards, view.camera.up)), half_height) << builtin.name;
        EXPECT_LT(std::abs(glm::dot(towards, view.camera.right)), aspect * half_height)
            << builtin.name;
    }
}

TEST(BuiltinScenes, DefaultJobsNameTheirSceneAndParameters)
{
    const Job job = job_of(find_builtin_scene("wall"), {{"thickness_m", 0.1}});
    EXPECT_EQ(job.scene.builtin, "wall");
    EXPECT_EQ(std::get<double>(job.scene.parameters.at("thickness_m")), 0.1);
    EXPECT_EQ(std::get<double>(job.scene.parameters.at("height_m")), 2.0);
}

TEST(BuiltinScenes, HoldTheSettingsOfTheirLessons)
{
    const Job cube = job_of(find_builtin_scene("sphere-cube"));
    EXPECT_EQ(cube.shadow_map.resolution_texels, 1024);
    EXPECT_EQ(cube.bias.constant, 0.1);
    EXPECT_EQ(cube.light->type, LightType::spot);

    const Job yard = job_of(find_builtin_scene("yard"));
    EXPECT_EQ(yard.shadow_map.frustum.half_extent_m, 20);
    EXPECT_EQ(yard.shadow_map.frustum.near_m, 0.01);
    EXPECT_EQ(yard.shadow_map.frustum.far_m, 100);
    EXPECT_TRUE(yard.shadow_map.depth_format.is_float());
    EXPECT_EQ(yard.lookup.filter, Filter::pcf3);

    const Job directional = job_of(find_builtin_scene("playground"));
    EXPECT_EQ(directional.shadow_map.frustum.fit, Fit::scene);
    EXPECT_FALSE(directional.shadow_map.frustum.near_m || directional.shadow_map.frustum.far_m);

    const Job distances = job_of(find_builtin_scene("two-distances"));
    EXPECT_EQ(distances.shadow_map.frustum.near_m, 4);
    EXPECT_EQ(distances.shadow_map.frustum.far_m, 50);
    EXPECT_EQ(distances.lookup.filter, Filter::linear);
    EXPECT_EQ(distances.lookup.outside, Outside::clamp);
    EXPECT_EQ(*distances.light->target, distances.camera->target);
}

TEST(SpherePlane, ChoosesItsLightByWord)
{
    const BuiltinScene& builtin = find_builtin_scene("sphere-plane");
    const Job spot = job_of(builtin);
    const Job orthographic = job_of(builtin, {{"light", std::string{"orthographic"}}});
    EXPECT_EQ(spot.light->type, LightType::spot);
    EXPECT_EQ(orthographic.light->type, LightType::directional);
    for (const Job& job : {spot, orthographic}) {
        EXPECT_EQ(job.shadow_map.resolution_texels, 512);
        EXPECT_EQ(job.shadow_map.frustum.near_m, 0.5);
        EXPECT_EQ(job.shadow_map.frustum.far_m, 10);
    }
}

TEST(TwoDistances, LiesBetweenNearAndFarOfItsLight)
{
    const BuiltinScene& builtin = find_builtin_scene("two-distances");
    const TriangleScene scene = build(builtin);
    const View view = resolve_view(job_of(builtin), scene, {});
    double nearest_m = 1e9;
    double farthest_m = 0;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        if (scene.objects[scene.object_of(i)].name == "floor") {
            continue;
        }
        for (const Vec3f& corner : scene.corners(i)) {
            const double light_distance_m = view.first_map().light_distance_m(Vec3d{corner});
            nearest_m = std::min(nearest_m, light_distance_m);
            farthest_m = std::max(farthest_m, light_distance_m);
        }
    }
    EXPECT_GT(nearest_m, 4.0);
    EXPECT_LT(nearest_m, 6.0);
    EXPECT_GT(farthest_m, 40.0);
    EXPECT_LT(farthest_m, 50.0);
}

TEST(TiltedPlane, StandsAtTheGivenAngleToTheLight)
{
    const BuiltinScene& builtin = find_builtin_scene("tilted-plane");
    for (const double angle_deg : {0.0, 20.0, 45.0, 70.0, 89.0}) {
        const auto c = build(builtin, {{"angle_deg", angle_deg}}).corners(0);
        const Vec3d normal =
            glm::normalize(glm::cross(Vec3d{c[1]} - Vec3d{c[0]}, Vec3d{c[2]} - Vec3d{c[0]}));
        // One rounding of the rise to float32, 2^-24 of it, turns the plane by at most 3e-8.
        EXPECT_NEAR(std::atan2(normal.x, normal.y), angle_deg * std::numbers::pi / 180, 6e-8);
        EXPECT_EQ(normal.z, 0.0);
    }
}

TEST(TiltedPlane, FillsTheViewWithThePlaneInsideTheMap)
{
    const BuiltinScene& builtin = find_builtin_scene("tilted-plane");
    for (const double angle_deg : {0.0, 45.0, 89.0}) {
        const ParameterValues given{{"angle_deg", angle_deg}};
        const double angle_rad = angle_deg * std::numbers::pi / 180;
        const Vec3d normal{std::sin(angle_rad), std::cos(angle_rad), 0};
        visit_view(job_of(builtin, given), build(builtin, given),
                   [&](const Vec3d& p, const View& view) {
                       ASSERT_TRUE(std::isfinite(p.x)) << angle_deg;
                       // 5 of 6.5 m: the widest filter's footprint stays inside as well.
                       EXPECT_LT(std::abs(p.x), 6.0) << angle_deg;
                       EXPECT_LT(std::abs(p.z), 6.0) << angle_deg;
                       EXPECT_EQ(view.first_map().top, 6.5);
                       EXPECT_GT(glm::dot(view.camera.eye - p, normal), 4.0) << angle_deg;
                   });
    }
}

TEST(Wall, IsASheetThatTouchesTheGroundInItsLowerEdgeOnly)
{
    const TriangleScene scene = build(find_builtin_scene("wall"));
    ASSERT_EQ(scene.objects.size(), 2U);
    ASSERT_EQ(scene.objects[1].name, "wall");
    ASSERT_EQ(scene.objects[1].triangle_count, 2U);
    for (std::uint32_t i = 0; i < 2; ++i) {
        for (const Vec3f& corner : scene.corners(scene.objects[1].first_triangle + i)) {
            EXPECT_EQ(corner.x, 0.0F);
            EXPECT_TRUE(corner.y == 0.0F || corner.y == 2.0F) << corner.y;
            EXPECT_EQ(std::abs(corner.z), 2.0F);
        }
    }
    EXPECT_EQ(scene.bounds().lower.y, 0.0);
}

TEST(Wall, KeepsItsShadowedFaceAtZeroWhenThick)
{
    const TriangleScene scene = build(find_builtin_scene("wall"), {{"thickness_m", 0.25}});
    ASSERT_EQ(scene.objects[1].triangle_count, 12U);
    float lower_m = 1;
    float upper_m = -1;
    for (std::uint32_t i = 0; i < 12; ++i) {
        for (const Vec3f& corner : scene.corners(scene.objects[1].first_triangle + i)) {
            lower_m = std::min(lower_m, corner.x);
            upper_m = std::max(upper_m, corner.x);
        }
    }
    EXPECT_EQ(lower_m, -0.25F);
    EXPECT_EQ(upper_m, 0.0F);
}

TEST(Wall, LeavesItsWholeShadowOnTheGround)
{
    const BuiltinScene& builtin = find_builtin_scene("wall");
    for (const double angle_deg : {1.0, 45.0, 80.0}) {
        const ParameterValues given{{"light_angle_deg", angle_deg}};
        const Vec3d direction = *job_of(builtin, given).light->direction;
        const double angle_rad = angle_deg * std::numbers::pi / 180;
        EXPECT_EQ(direction, Vec3d(std::sin(angle_rad), -std::cos(angle_rad), 0.0));
        EXPECT_GT(build(builtin, given).bounds().upper.x, 2 * std::tan(angle_rad));
    }
}

TEST(Room, BlocksTheSunFromEverythingInside)
{
    const BuiltinScene& builtin = find_builtin_scene("room");
    for (const double thickness_m : {0.001, 0.2, 2.0}) {
        const ParameterValues given{{"wall_thickness_m", thickness_m}};
        const TriangleScene scene = build(builtin, given);
        visit_view(job_of(builtin, given), scene, [&](const Vec3d& p, const View& view) {
            ASSERT_TRUE(std::isfinite(p.x)) << thickness_m;
            // 0.1 mm on, P's own wall is behind; the thinnest wall is 1 mm.
            EXPECT_LT(nearest_hit(scene, {p, -view.light.direction}, 1e-4), 100.0) << thickness_m;
        });
    }
}

TEST(SphereField, HasExactlyTheAgreedTriangles)
{
    const TriangleScene scene = build(find_builtin_scene("sphere-field"));
    EXPECT_EQ(scene.triangles.size(), 1'048'578U);
    EXPECT_EQ(scene.objects.size(), 65U);
}

TEST(Columns, HasAboutAHundredThousandTriangles)
{
    const TriangleScene scene = build(find_builtin_scene("columns"));
    EXPECT_GE(scene.triangles.size(), 80'000U);
    EXPECT_LE(scene.triangles.size(), 120'000U);
}

TEST(Terrain, HasTheTrianglesOfItsCellsAndStaysWithinItsRelief)
{
    const TriangleScene scene = build(find_builtin_scene("terrain"), {{"cells", 32.0}});
    EXPECT_EQ(scene.triangles.size(), 2U * 32 * 32);
    EXPECT_LE(scene.bounds().upper.y, 4.0);
    EXPECT_GE(scene.bounds().lower.y, -4.0);
    EXPECT_GT(scene.bounds().upper.y - scene.bounds().lower.y, 1.0);
}

TEST(Terrain, ChangesWithItsSeed)
{
    const BuiltinScene& builtin = find_builtin_scene("terrain");
    EXPECT_NE(content_hash(build(builtin, {{"seed", 1.0}})),
              content_hash(build(builtin, {{"seed", 2.0}})));
}

TEST(Parameters, HaveDefaultsThatAreAllowed)
{
    for (const BuiltinScene& builtin : builtin_scenes()) {
        for (const BuiltinParameter& parameter : builtin.parameters) {
            EXPECT_NO_THROW(
                (void)complete_parameters(builtin, {{parameter.name, parameter.default_value}}))
                << builtin.name << " " << parameter.name;
            EXPECT_FALSE(parameter.description.empty()) << builtin.name << " " << parameter.name;
        }
    }
}

TEST(Parameters, OutOfRangeAreRefusedWithKeyValueAndRange)
{
    for (const double value : {-0.1, 2.1, std::nan(""), HUGE_VAL}) {
        EXPECT_THAT(refusal("wall", {{"thickness_m", value}}),
                    AllOf(HasSubstr("scene.wall.thickness_m = "), HasSubstr("from 0 to 2 m")))
            << value;
    }
    EXPECT_THAT(refusal("fence", {{"slat_count", 2.5}}),
                AllOf(HasSubstr("2.5"), HasSubstr("an integer from 1 to 1000")));
}

TEST(Parameters, OfTheWrongTypeAreRefused)
{
    EXPECT_THAT(refusal("wall", {{"thickness_m", std::string{"thin"}}}),
                AllOf(HasSubstr("= \"thin\""), HasSubstr("a number from 0 to 2 m")));
    EXPECT_THAT(refusal("sphere-plane", {{"light", 3.0}}),
                AllOf(HasSubstr("= 3:"), HasSubstr("\"spot\" or \"orthographic\"")));
    EXPECT_THAT(refusal("sphere-plane", {{"light", std::string{"point"}}}),
                HasSubstr("\"spot\" or \"orthographic\""));
}

TEST(Parameters, OfUnknownNameAreRefusedWithTheNearest)
{
    EXPECT_THAT(refusal("wall", {{"thicknes_m", 0.1}}),
                AllOf(HasSubstr("scene.wall.thicknes_m"), HasSubstr("\"thickness_m\""),
                      Not(HasSubstr("\n"))));
    EXPECT_THAT(refusal("sphere-field", {{"count", 3.0}}), HasSubstr("has no parameters"));
}

TEST(FindBuiltinScene, RefusesAnUnknownNameWithTheNearest)
{
    try {
        (void)find_builtin_scene("colums");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("\"colums\""), HasSubstr("\"columns\"")));
    }
}

} // namespace
} // namespace gnomon::scene
