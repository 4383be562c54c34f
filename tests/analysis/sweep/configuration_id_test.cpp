// The parts of a scene and a job that ids depend on.

#include "analysis/sweep/configuration_id.hpp"

#include "analysis/sweep/sweep_curves.hpp"
#include "scene/job/source.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::CameraSettings;
using scene::LightSettings;
using scene::SceneDefaults;

constexpr const char* hash_of_triangles = "0123456789abcdef";

std::string identity_name(const SceneDefaults& defaults, const scene::Job& job = {})
{
    return identify_scene(job, hash_of_triangles, defaults).name();
}

SceneDefaults file_of(const CameraSettings& camera, const LightSettings& light)
{
    return {camera, light};
}

LightSettings spot_light()
{
    LightSettings light;
    light.type = scene::LightType::spot;
    light.position = scene::Vec3d{4, 6, 4};
    light.target = scene::Vec3d{0, 0, 0};
    return light;
}

LightSettings directional_light()
{
    LightSettings light;
    light.direction = scene::Vec3d{0, -1, 0};
    return light;
}

TEST(SceneIdentity, IsTheHashWhereNothingIsTakenFromTheFile)
{
    // Runs on disk depend on this: with a changed id, a sweep starts anew.
    EXPECT_EQ(identity_name({}), hash_of_triangles);
    scene::Job job;
    job.camera.emplace();
    job.light.emplace();
    EXPECT_EQ(identity_name(file_of({}, spot_light()), job), hash_of_triangles);
}

TEST(SceneIdentity, HasWhatTheJobLeavesToTheFile)
{
    EXPECT_EQ(identify_scene({}, hash_of_triangles, file_of({}, spot_light())).taken_keys,
              "\ncamera.eye=[0, 2, 6]\ncamera.target=[0, 0.5, 0]\ncamera.up=[0, 1, 0]"
              "\ncamera.vertical_fov_deg=45\nlight.type=\"spot\"\nlight.position=[4, 6, 4]"
              "\nlight.target=[0, 0, 0]\nlight.cone_deg=60");
    scene::Job lit;
    lit.light = directional_light();
    EXPECT_EQ(identity_name(file_of({}, spot_light()), lit),
              identity_name(file_of({}, directional_light()), lit));
    EXPECT_EQ(identity_name(file_of({}, spot_light()), lit), identity_name({CameraSettings{}, {}}));
    scene::Job seen;
    seen.camera.emplace();
    EXPECT_EQ(identity_name(file_of({}, spot_light()), seen), identity_name({{}, spot_light()}));
}

TEST(SceneIdentity, IsAnotherWhereAnythingTakenDiffers)
{
    std::vector<SceneDefaults> files{
        {}, {CameraSettings{}, {}}, {{}, spot_light()}, {{}, directional_light()}};
    const std::vector<std::function<void(CameraSettings&)>> camera_changes{
        [](auto& camera) { camera.eye.x = 1e-9; }, [](auto& camera) { camera.target.y = 0.25; },
        [](auto& camera) { camera.up.z = 1; },
        [](auto& camera) { camera.projection = scene::Projection::orthographic; },
        [](auto& camera) { camera.vertical_fov_deg = std::nextafter(45.0, 46.0); }};
    for (const auto& change : camera_changes) {
        change(*files.emplace_back(file_of({}, spot_light())).camera);
    }
    const std::vector<std::function<void(LightSettings&)>> light_changes{
        [](auto&) {}, [](auto& light) { light = directional_light(); },
        [](auto& light) { (*light.position).x = 5; }, [](auto& light) { (*light.target).y = 1; },
        [](auto& light) { light.cone_deg = 61; }};
    for (const auto& change : light_changes) {
        change(*files.emplace_back(file_of({}, spot_light())).light);
    }
    std::set<std::string> names;
    for (const SceneDefaults& file : files) {
        EXPECT_TRUE(names.insert(identity_name(file)).second) << identity_name(file);
    }
}

TEST(SceneIdentity, IsEqualOnlyWhereTheJobSeesAndLightsAlike)
{
    std::mt19937 random{11};
    const auto few = [&] { return static_cast<double>(random() % 2); };
    const auto draw = [&] {
        SceneDefaults file;
        if (random() % 2 == 0) {
            file.camera.emplace().eye = {few(), 3, 4 + few()};
            file.camera->vertical_fov_deg = 40 + few();
        }
        if (random() % 2 == 0) {
            file.light = random() % 2 == 0 ? directional_light() : spot_light();
            file.light->cone_deg = 60 + few(); // a sun has none
        }
        return file;
    };
    scene::SceneBuilder builder;
    const std::vector<scene::Vec3d> vertices{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
    const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 2, 1}};
    builder.add("ground", vertices, triangle);
    const scene::TriangleScene ground = builder.take();
    int equal_names = 0;
    for (int i = 0; i < 2000; ++i) {
        scene::Job job;
        if (random() % 2 == 0) {
            job.camera.emplace();
        }
        const SceneDefaults a = draw();
        const SceneDefaults b = draw();
        if (identity_name(a, job) != identity_name(b, job)) {
            continue;
        }
        ++equal_names;
        const scene::View of_a = scene::resolve_view(job, ground, a);
        const scene::View of_b = scene::resolve_view(job, ground, b);
        SCOPED_TRACE(fmt::format("pair {}: {}", i, identity_name(a, job)));
        EXPECT_EQ(of_a.camera.eye, of_b.camera.eye);
        EXPECT_EQ(of_a.camera.half_height, of_b.camera.half_height);
        EXPECT_EQ(of_a.light.type, of_b.light.type);
        EXPECT_EQ(of_a.light.direction, of_b.light.direction);
        EXPECT_EQ(of_a.light.cos_half_cone, of_b.light.cos_half_cone);
        EXPECT_EQ(of_a.first_map().far_m, of_b.first_map().far_m);
    }
    EXPECT_GT(equal_names, 100);
}

scene::SweepSpace wall_space(const std::vector<std::string>& axes)
{
    return {scene::builtin_job_source("wall", {}), axes};
}

bool may_repeat(const scene::SweepSpace& space)
{
    const SweepCurves sweep_curves{space, false, "1.0"};
    return sweep_curves.may_repeat(
        std::vector<SceneIdentity>(sweep_curves.requests().size(), {"0123456789abcdef", ""}));
}

TEST(SweepRepeats, MayOccurWhereScenesOrCasesMayBeEqual)
{
    EXPECT_FALSE(may_repeat(wall_space({"bias.constant=0,0.5", "bias.slope=0,1"})));
    EXPECT_FALSE(may_repeat(wall_space({"bias.constant=0,0.5", "lookup.filter=pcf3,hardware"})));
    // Two scenes of the same content.
    EXPECT_TRUE(may_repeat({scene::JobSource{}, {"scene.file=a.obj,b.obj"}}));

    scene::JobSource cases = scene::builtin_job_source("wall", {});
    cases.cases = {{"one", {}}, {"same", {}}};
    EXPECT_TRUE(may_repeat({cases, {}}));
    EXPECT_TRUE(may_repeat({cases, {"bias.constant=0,0.5"}}));

    scene::JobSource zipped = scene::builtin_job_source("wall", {});
    zipped.sweep.mode = "zip";
    EXPECT_FALSE(may_repeat({zipped, {"bias.constant=0.5,0,0.5", "bias.slope=1,1,2"}}));
}

} // namespace
} // namespace gnomon::analysis
