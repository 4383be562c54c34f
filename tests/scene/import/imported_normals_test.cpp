#include "scene/import/load_scene_file.hpp"
#include "scene/load/load_scene.hpp"
#include "scene_file_fixture.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace gnomon::scene {
namespace {

using test::TemporaryFolder;

/// A square in the plane z = 0 that faces +z, whose corners' normals lean outward along x.
constexpr std::string_view obj_with_normals =
    "o quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn -0.6 0 0.8\nvn 0.6 0 0.8\n"
    "f 1//1 2//2 3//2 4//1\n";

TriangleScene load(const std::string& name, std::string_view contents)
{
    const TemporaryFolder folder;
    return load_scene_file(folder.write(name, contents), {}, VertexNormals::kept).scene;
}

/// Checks each corner's normal by the corner's position.
void expect_lean(const TriangleScene& scene, float middle_x, const Vec3f& below, const Vec3f& above)
{
    ASSERT_EQ(scene.attributes.size(), scene.triangles.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const auto corners = scene.corners(t);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3f& expected = corners.at(k).x < middle_x ? below : above;
            // A product or two in double, rounded once.
            EXPECT_LE(glm::length(scene.attributes[t].at(k).normal - expected), 2e-7F)
                << "triangle " << t << " corner " << k;
        }
    }
}

TEST(ImportedNormals, AreThoseOfAnObjFile)
{
    const TriangleScene scene = load("quad.obj", obj_with_normals);
    EXPECT_EQ(scene.vertices.size(), 4U) << "positions are shared as without normals";
    expect_lean(scene, 0.5F, {-0.6F, 0, 0.8F}, {0.6F, 0, 0.8F});
}

TEST(ImportedNormals, MayDifferAtOneVertex)
{
    // Two triangles that share an edge, hard.
    const TriangleScene scene =
        load("hard.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0.6 0.8\n"
                         "f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n");
    ASSERT_EQ(scene.vertices.size(), 4U);
    EXPECT_EQ(scene.attributes.at(0)[0].normal, Vec3f(0, 0, 1));
    EXPECT_EQ(scene.attributes.at(1)[0].normal, Vec3f(0, 0.6F, 0.8F));
}

TEST(ImportedNormals, AreThoseOfAPlyFile)
{
    const TriangleScene scene =
        load("quad.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty "
                         "float y\nproperty float z\nproperty float nx\nproperty float ny\n"
                         "property float nz\nelement face 1\nproperty list uchar int "
                         "vertex_indices\nend_header\n0 0 0 -0.6 0 0.8\n1 0 0 0.6 0 0.8\n"
                         "1 1 0 0.6 0 0.8\n0 1 0 -0.6 0 0.8\n4 0 1 2 3\n");
    expect_lean(scene, 0.5F, {-0.6F, 0, 0.8F}, {0.6F, 0, 0.8F});
}

/// The quad as glTF, under a node with this transform.
std::string gltf_with_normals(const std::string& transform)
{
    constexpr std::array<float, 12> normals{-0.6F, 0, 0.8F, 0.6F,  0, 0.8F,
                                            0.6F,  0, 0.8F, -0.6F, 0, 0.8F};
    const std::string bytes = test::quad_buffer() + test::bytes_of(normals);
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],)"
        R"("nodes":[{{"name":"quad","mesh":0{}}}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":1,"NORMAL":2}},"indices":0}}]}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":5123,"count":6,"type":"SCALAR"}},)"
        R"({{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"}},)"
        R"({{"bufferView":2,"componentType":5126,"count":4,"type":"VEC3"}}],)"
        R"("bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":12}},)"
        R"({{"buffer":0,"byteOffset":12,"byteLength":48}},)"
        R"({{"buffer":0,"byteOffset":60,"byteLength":48}}],)"
        R"("buffers":[{{"uri":"data:application/octet-stream;base64,{}","byteLength":108}}]}})",
        transform, test::base64(bytes));
}

TEST(ImportedNormals, AreThoseOfAGltfFile)
{
    expect_lean(load("quad.gltf", gltf_with_normals("")), 0.5F, {-0.6F, 0, 0.8F}, {0.6F, 0, 0.8F});
}

TEST(ImportedNormals, FollowTheInverseTransposeOfTheirNode)
{
    // Twice as wide: (±0.6 / 2, 0, 0.8), made unit.
    const double length = std::hypot(0.3, 0.8);
    const auto x = static_cast<float>(0.3 / length);
    const auto z = static_cast<float>(0.8 / length);
    expect_lean(load("wide.gltf", gltf_with_normals(R"(,"scale":[2,1,1])")), 1, {-x, 0, z},
                {x, 0, z});
}

TEST(ImportedNormals, KeepTheirCornersInAMirroredInstance)
{
    // x from −1 to 0: the normal that leaned to −x at 0 leans to +x there.
    const TriangleScene scene = load("mirrored.gltf", gltf_with_normals(R"(,"scale":[-1,1,1])"));
    expect_lean(scene, -0.5F, {-0.6F, 0, 0.8F}, {0.6F, 0, 0.8F});
}

TEST(ImportedNormals, AreNotKeptUnlessAskedFor)
{
    const TemporaryFolder folder;
    EXPECT_TRUE(
        load_scene_file(folder.write("quad.obj", obj_with_normals)).scene.attributes.empty());
}

TEST(ImportedNormals, ThatAreMissingAreThoseOfFaces)
{
    const TemporaryFolder folder;
    SceneSettings settings;
    // The second object has no normals, and one normal of the first is 0.
    settings.file = folder.write(
        "some.obj", "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0.6 0 0.8\nvn 0 0 0\nf 1//1 2//2 3//1\n"
                    "o b\nv 0 0 5\nv 1 0 5\nv 1 1 5\nf 4 5 6\n");
    settings.ground = true;
    const TriangleScene scene = load_scene(settings, VertexNormals::kept).scene;
    ASSERT_EQ(scene.attributes.size(), 4U);
    EXPECT_EQ(scene.attributes[0][0].normal, Vec3f(0.6F, 0, 0.8F));
    EXPECT_EQ(scene.attributes[0][1].normal, Vec3f(0, 0, 1));
    EXPECT_EQ(scene.attributes[1][0].normal, Vec3f(0, 0, 1));
    EXPECT_EQ(scene.attributes[3][2].normal, Vec3f(0, 1, 0)) << "the ground's";
}

} // namespace
} // namespace gnomon::scene
