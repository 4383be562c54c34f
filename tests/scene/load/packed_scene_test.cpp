// Packed scenes equal the scenes of their files, and damaged ones cannot harm the reader.

#include "scene/load/load_scene.hpp"

#include "scene_file_fixture.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace gnomon::scene {
namespace {

using test::QuadGltf;
using test::TemporaryFolder;

using Bytes = std::vector<std::byte>;

constexpr std::string_view tent =
    "o tent\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv 0 1.5 0\nvn -0.6 0.8 0\nvn 0.6 0.8 0\n"
    "f 1//1 4//2 2//2\nf 2//2 4//1 3//2\n";

Bytes packed(const SceneSettings& settings, VertexNormals normals)
{
    const SealedBytes sealed = pack_scene(settings, normals);
    return {sealed.bytes().begin(), sealed.bytes().end()};
}

void expect_same(const SceneFile& a, const SceneFile& b)
{
    EXPECT_EQ(a.scene.vertices, b.scene.vertices);
    EXPECT_EQ(a.scene.triangles, b.scene.triangles);
    EXPECT_EQ(a.scene.attributes, b.scene.attributes);
    EXPECT_EQ(a.scene.dropped_triangles, b.scene.dropped_triangles);
    ASSERT_EQ(a.scene.objects.size(), b.scene.objects.size());
    for (std::size_t i = 0; i < a.scene.objects.size(); ++i) {
        EXPECT_EQ(a.scene.objects[i].name, b.scene.objects[i].name);
        EXPECT_EQ(a.scene.objects[i].casts, b.scene.objects[i].casts);
    }
    EXPECT_EQ(a.defaults.camera.has_value(), b.defaults.camera.has_value());
    EXPECT_EQ(a.lights.size(), b.lights.size());
}

/// The scene, if the bytes are one. A refusal must be one line.
std::optional<SceneFile> unpacked(const SceneSettings& settings, const Bytes& bytes)
{
    try {
        return load_packed_scene(settings, bytes, VertexNormals::kept);
    } catch (const InputError& error) {
        EXPECT_EQ(std::string_view{error.what()}.find('\n'), std::string_view::npos);
        return std::nullopt;
    }
}

class PackedScenes : public ::testing::Test {
protected:
    [[nodiscard]] SceneSettings settings(const std::string& name, std::string_view contents) const
    {
        SceneSettings of_file;
        of_file.file = folder.write(name, contents);
        of_file.ground = true;
        return of_file;
    }

    TemporaryFolder folder;
};

TEST_F(PackedScenes, AreTheScenesOfTheirFiles)
{
    QuadGltf gltf;
    gltf.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],)";
    gltf.nodes = R"([{"name":"quad","mesh":0},{"camera":0,"translation":[0,0,5]}])";
    gltf.roots = "[0,1]";
    for (SceneSettings file : {settings("tent.obj", tent), settings("quad.gltf", gltf.text()),
                               settings("quad.glb", gltf.binary())}) {
        for (const VertexNormals normals : {VertexNormals::kept, VertexNormals::dropped}) {
            SCOPED_TRACE(file.file.filename().string());
            const SceneFile whole = load_scene(file, normals);
            const Bytes bytes = packed(file, normals);
            file.file = "elsewhere" / file.file.filename(); // it need not be there
            expect_same(load_packed_scene(file, bytes, normals), whole);
            file.file = folder.path() / file.file.filename();
        }
    }
}

TEST_F(PackedScenes, ThatAreCutShortAreRefused)
{
    const SceneSettings file = settings("tent.obj", tent);
    const Bytes whole = packed(file, VertexNormals::kept);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(unpacked(file, part)) << size << " of " << whole.size() << " bytes";
    }
}

TEST_F(PackedScenes, ThatAreDamagedAreRefusedOrAreScenes)
{
    const SceneSettings file = settings("tent.obj", tent);
    const Bytes whole = packed(file, VertexNormals::kept);
    std::mt19937 random{11};
    std::size_t refused = 0;
    for (int i = 0; i < 2'000; ++i) {
        Bytes damaged = whole;
        const std::size_t place = random() % damaged.size();
        const auto bit = static_cast<std::byte>(1U << random() % 8);
        damaged[place] ^= bit;
        const std::optional<SceneFile> found = unpacked(file, damaged);
        refused += found ? 0U : 1U;
        if (!found) {
            continue;
        }
        const TriangleScene& scene = found->scene;
        EXPECT_TRUE(std::ranges::all_of(scene.triangles,
                                        [&](const auto& triangle) {
                                            return std::ranges::all_of(
                                                triangle, [&](std::uint32_t vertex) {
                                                    return vertex < scene.vertices.size();
                                                });
                                        }))
            << "byte " << place << ", bit " << static_cast<int>(bit);
    }
    EXPECT_GT(refused, 100U);
}

} // namespace
} // namespace gnomon::scene
