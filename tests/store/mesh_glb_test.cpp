#include "store/case/case_files.hpp"

#include "scene/builtin/scenes.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/load/load_scene.hpp"
#include "store/output_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon::store {
namespace {

/// The bits of a triangle's corners.
std::array<std::uint32_t, 9> corner_bits(const scene::TriangleScene& scene, std::uint32_t triangle)
{
    std::array<std::uint32_t, 9> bits{};
    std::size_t next = 0;
    for (const scene::Vec3f& corner : scene.corners(triangle)) {
        for (int i = 0; i < 3; ++i) {
            bits[next++] = std::bit_cast<std::uint32_t>(corner[i]);
        }
    }
    return bits;
}

TEST(MeshGlb, ImportsBitByBit)
{
    const auto file = std::filesystem::path{::testing::TempDir()} / "mesh_glb_test.glb";
    for (const char* const name : {"sphere-plane", "yard", "fence", "columns"}) {
        scene::SceneSettings settings;
        settings.builtin = name;
        const scene::TriangleScene own = scene::load_scene(settings).scene;
        write_file(file, encode_glb(own));
        const scene::TriangleScene back = scene::load_scene_file(file).scene;
        ASSERT_EQ(back.triangles.size(), own.triangles.size()) << name;
        ASSERT_EQ(back.objects.size(), own.objects.size()) << name;
        for (std::size_t i = 0; i < own.objects.size(); ++i) {
            EXPECT_EQ(back.objects[i].name, own.objects[i].name) << name;
            EXPECT_EQ(back.objects[i].triangle_count, own.objects[i].triangle_count) << name;
        }
        std::size_t different = 0;
        for (std::uint32_t t = 0; t < own.triangles.size(); ++t) {
            different += corner_bits(own, t) != corner_bits(back, t) ? 1U : 0U;
        }
        EXPECT_EQ(different, 0U) << name;
    }
    std::filesystem::remove(file);
}

TEST(MeshGlb, KeepsNormalsBitByBit)
{
    const auto file = std::filesystem::path{::testing::TempDir()} / "mesh_glb_normals_test.glb";
    for (const char* const name : {"sphere-cube", "columns"}) {
        scene::SceneSettings settings;
        settings.builtin = name;
        const auto kept = scene::VertexNormals::kept;
        const scene::TriangleScene own = scene::load_scene(settings, kept).scene;
        write_file(file, encode_glb(own));
        const scene::TriangleScene back = scene::load_scene_file(file, {}, kept).scene;
        ASSERT_EQ(back.triangles.size(), own.triangles.size()) << name;
        EXPECT_EQ(back.attributes, own.attributes) << name;
        std::size_t different = 0;
        for (std::uint32_t t = 0; t < own.triangles.size(); ++t) {
            different += corner_bits(own, t) != corner_bits(back, t) ? 1U : 0U;
        }
        EXPECT_EQ(different, 0U) << name;
    }
    std::filesystem::remove(file);
}

} // namespace
} // namespace gnomon::store
