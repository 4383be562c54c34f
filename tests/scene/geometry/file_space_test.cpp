// A scene file's unit and up axis.

#include "scene/load/load_scene.hpp"
#include "scene_file_fixture.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace gnomon::scene {
namespace {

using test::QuadGltf;
using test::TemporaryFolder;

constexpr const char* corner_obj = "v 0.1 0.2 0.3\nv 600 -0.25 7\nv 3 4.5 -1\nf 1 2 3\n";

SceneSettings settings_of(const std::filesystem::path& file, std::optional<double> unit_m,
                          UpAxis up)
{
    SceneSettings settings;
    settings.file = file;
    settings.unit_m = unit_m;
    settings.up = up;
    return settings;
}

TEST(FileSpace, ScalesAndTurnsInDoubleBeforeTheOneRounding)
{
    const TemporaryFolder folder;
    const auto file = folder.write("corner.obj", corner_obj);
    const auto own = load_scene(settings_of(file, {}, UpAxis::y)).scene.corners(0);
    for (const double unit_m : {0.01, 0.0254, 1.0, 1000.0}) {
        const auto scaled = load_scene(settings_of(file, unit_m, UpAxis::y)).scene.corners(0);
        const auto turned = load_scene(settings_of(file, unit_m, UpAxis::z)).scene.corners(0);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3d exact = unit_m * Vec3d{own[i]};
            EXPECT_EQ(scaled[i], Vec3f{exact}) << unit_m;
            EXPECT_EQ(turned[i], Vec3f(Vec3d{exact.x, exact.z, -exact.y})) << unit_m;
        }
    }
}

TEST(FileSpace, TakesTheFilesCameraAndLightAlong)
{
    QuadGltf gltf;
    gltf.more = R"("cameras":[{"type":"orthographic","orthographic":{"xmag":3,"ymag":1.5,)"
                R"("znear":0.1,"zfar":10}}],"extensionsUsed":["KHR_lights_punctual"],)"
                R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},)";
    gltf.nodes = R"([{"mesh":0},{"camera":0,"translation":[0,4,8]},{"translation":[1,2,4],)"
                 R"("extensions":{"KHR_lights_punctual":{"light":0}}}])";
    gltf.roots = "[0,1,2]";
    const TemporaryFolder folder;
    const auto file = folder.write("quad.gltf", gltf.text());
    const SceneFile loaded = load_scene(settings_of(file, 0.5, UpAxis::z));
    // The camera looks along −z, which becomes −y; its y becomes −z.
    ASSERT_TRUE(loaded.defaults.camera);
    EXPECT_EQ(loaded.defaults.camera->eye, Vec3d(0, 4, -2));
    EXPECT_EQ(loaded.defaults.camera->target, Vec3d(0, 3, -2));
    EXPECT_EQ(loaded.defaults.camera->up, Vec3d(0, 0, -1));
    EXPECT_EQ(loaded.defaults.camera->orthographic_height_m, 1.5); // half of 2 ymag
    ASSERT_TRUE(loaded.defaults.light);
    EXPECT_EQ(loaded.defaults.light->position, Vec3d(0.5, 2, -1));
}

TEST(FileSpace, TurnsNormalsWithTheirFaces)
{
    const TemporaryFolder folder;
    const auto file = folder.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n"
                                               "f 1//1 2//1 3//1\n");
    const TriangleScene scene =
        load_scene(settings_of(file, 3, UpAxis::z), VertexNormals::kept).scene;
    const auto [a, b, c] = scene.corners(0);
    EXPECT_EQ(glm::normalize(glm::cross(Vec3d{b - a}, Vec3d{c - a})), Vec3d(0, 1, 0));
    EXPECT_EQ(Vec3d{scene.attributes.at(0)[0].normal}, Vec3d(0, 1, 0));
}

TEST(FileSpace, NamesTheUnitOfLengths)
{
    SceneSettings settings;
    settings.builtin = "wall";
    EXPECT_EQ(length_unit(settings), "m");
    settings = settings_of("a.obj", {}, UpAxis::y);
    EXPECT_EQ(length_unit(settings), "units");
    settings.unit_m = 1;
    EXPECT_EQ(length_unit(settings), "m");
}

} // namespace
} // namespace gnomon::scene
