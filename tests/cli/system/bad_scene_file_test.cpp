#include "child_process.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace gnomon::testing {
namespace {

using scene::test::base64;
using scene::test::quad_buffer;
using scene::test::quad_indices;
using scene::test::QuadCorners;
using scene::test::QuadGltf;
using scene::test::QuadIndices;
using scene::test::unit_quad;

/// An ASCII PLY triangle; the second coordinate of its first vertex is given.
std::string ply(int face_count, const std::string& y, const std::string& faces)
{
    return fmt::format("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\nelement face {}\n"
                       "property list uchar int vertex_indices\nend_header\n"
                       "0 {} 0\n1 0 0\n0 0 1\n{}",
                       face_count, y, faces);
}

std::string gltf_of(const QuadCorners& corners, const QuadIndices& indices = quad_indices)
{
    QuadGltf gltf;
    gltf.buffer = fmt::format(R"("uri":"data:application/octet-stream;base64,{}",)",
                              base64(quad_buffer(corners, indices)));
    return gltf.text();
}

std::string gltf_with_coordinate(float value)
{
    QuadCorners corners = unit_quad;
    corners[4] = value;
    return gltf_of(corners);
}

/// Writes the scene file and expects gnomon to refuse it in time.
void expect_file_refused(const std::string& name, const std::string& contents,
                         const std::string& message)
{
    const TemporaryFolder folder;
    const auto file = folder.write(name, contents);
    const Ending ending = gnomon(small({"compare", file}));
    expect_refused(ending, 2, message);
    EXPECT_LT(ending.time_s, 10) << name;
}

TEST(BadSceneFile, IsAcceptedWhenItIsGood)
{
    // The files below differ from these three only in their defect.
    const TemporaryFolder folder;
    for (const auto& [name, contents] :
         {std::pair<std::string, std::string>{"good.ply", ply(1, "0", "3 0 1 2\n")},
          {"good.gltf", QuadGltf{}.text()},
          {"good.glb", QuadGltf{}.binary()},
          {"good.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"}}) {
        expect_done(gnomon(small({"compare", folder.write(name, contents)})));
    }
}

TEST(BadSceneFile, WithAVertexThatIsNotFiniteIsRefused)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::string end = "\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
    expect_file_refused("nan.obj", "v nan 0 0" + end, "vertex 0: the x coordinate is nan");
    expect_file_refused("infinite.obj", "v 0 inf 0" + end, "vertex 0: the y coordinate is inf");
    expect_file_refused("overflow.obj", "v 0 1e400 0" + end, "vertex 0: the y coordinate is inf");
    expect_file_refused("nan.ply", ply(1, "nan", "3 0 1 2\n"), "coordinate is nan");
    expect_file_refused("far.ply", ply(1, "1e16", "3 0 1 2\n"), "within ±1e15");
    expect_file_refused("nan.gltf", gltf_with_coordinate(nan), "object \"quad\", vertex");
    expect_file_refused("infinite.gltf", gltf_with_coordinate(infinity), "coordinate is inf");
}

TEST(BadSceneFile, WithAnIndexOutOfRangeIsRefused)
{
    expect_file_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 4\n", "out of range");
    expect_file_refused("index.ply", ply(1, "0", "3 0 1 7\n"), "vertex index 7 of 3");
    expect_file_refused("index.gltf", gltf_of(unit_quad, {0, 1, 9, 0, 2, 9}), "index.gltf");
}

TEST(BadSceneFile, WithRecursiveNodesIsRefused)
{
    QuadGltf gltf;
    gltf.nodes = R"([{"mesh":0,"children":[1]},{"children":[0]}])";
    expect_file_refused("nodes.gltf", gltf.text(), "recursive");
    gltf.nodes = R"([{"mesh":0,"children":[0]}])";
    expect_file_refused("node.gltf", gltf.text(), "recursive");
}

TEST(BadSceneFile, WithoutATriangleIsRefused)
{
    expect_file_refused("vertices.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\n", "no triangle");
    expect_file_refused("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "1 of zero area");
    expect_file_refused("faces.ply", ply(0, "0", ""), "no triangle");
    expect_file_refused("collapsed.gltf", gltf_of(QuadCorners{}), "2 of zero area");
}

TEST(BadSceneFile, IsRefusedWhereverItWasCutOff)
{
    const std::string whole = QuadGltf{}.binary();
    // In the header, after it, in the JSON, between the chunks, and one byte before the end.
    for (const std::size_t length :
         {std::size_t{1}, std::size_t{11}, std::size_t{12}, std::size_t{20}, whole.size() / 2,
          whole.size() - 68, whole.size() - 60, whole.size() - 1}) {
        SCOPED_TRACE(length);
        expect_file_refused("cut.glb", whole.substr(0, length), "cut.glb");
    }
}

TEST(BadSceneFile, OfTheWrongKindIsRefused)
{
    expect_file_refused("model.stl", "solid a\nendsolid a\n", "model.stl");
    expect_file_refused("text.glb", "this is no model\n", "text.glb");
    expect_file_refused("json.gltf", "{", "json.gltf");
}

} // namespace
} // namespace gnomon::testing
