// No triangle of a file is lost silently.

#include "lane.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene/load/load_scene.hpp"
#include "scene_file_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {
namespace {

using test::QuadGltf;
using test::QuadIndices;
using test::refusal_of;
using test::TemporaryFolder;
using test::with_primitives;
using ::testing::HasSubstr;

std::string quad_with_indices(const QuadIndices& indices)
{
    QuadGltf gltf;
    gltf.buffer = fmt::format(R"("uri":"data:application/octet-stream;base64,{}",)",
                              test::base64(test::quad_buffer(test::unit_quad, indices)));
    return gltf.text();
}

TEST(LostTriangles, OfGltfAreRefusedWithTheirNumber)
{
    EXPECT_THAT(refusal_of("a.gltf", quad_with_indices({0, 1, 2, 0, 2, 9})),
                HasSubstr("vertex index out of range, in 1 of its 2 triangles; export it again"));
    for (const int mode : {5, 6}) {
        QuadGltf gltf;
        gltf.buffer =
            fmt::format(R"("uri":"data:application/octet-stream;base64,{}",)",
                        test::base64(test::quad_buffer(test::unit_quad, {0, 1, 2, 3, 0, 9})));
        EXPECT_THAT(refusal_of("a.gltf",
                               with_primitives(gltf, fmt::format(R"([{{"attributes":)"
                                                                 R"({{"POSITION":1}},"indices":0,)"
                                                                 R"("mode":{}}}])",
                                                                 mode))),
                    HasSubstr("vertex index out of range"))
            << mode;
    }
}

TEST(LostTriangles, AreRefusedWhereIndicesMakeNoWholeNumber)
{
    std::string text = QuadGltf{}.text();
    const std::string six = R"("count":6)";
    text.replace(text.find(six), six.size(), R"("count":5)");
    EXPECT_THAT(refusal_of("a.gltf", text),
                HasSubstr("has 5 indices, which is not a whole number of triangles"));
}

TEST(LostTriangles, AreRefusedInGltf10Too)
{
    const std::string text =
        R"({"asset":{"version":"1.0"},"accessors":{"corners":{"count":35}},"meshes":{"m":)"
        R"({"name":"box","primitives":[{"indices":"corners","mode":4}]}}})";
    EXPECT_THAT(refusal_of("a.gltf", text),
                HasSubstr("mesh \"box\" has 35 indices, which is not a whole number of triangles"));
}

TEST(LostTriangles, OfPlyStripsAreRefused)
{
    EXPECT_THAT(
        refusal_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                            "property float y\nproperty float z\nelement tristrips 1\n"
                            "property list int int vertex_indices\nend_header\n"
                            "0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n"),
        HasSubstr(
            "it has triangle strips (element tristrips), which are not supported; export faces "
            "instead"));
}

/// A square's two triangles; the header has the format and an unknown property.
std::string square_ply(std::string_view format, std::string_view data)
{
    return fmt::format(
        "ply\nformat {} 1.0\ncomment a square\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\nproperty uchar quality\nelement face 2\n"
        "property list uchar ushort vertex_indices\nend_header\n{}",
        format, data);
}

TEST(LostTriangles, OfAPlyFileThatIsCutOffAreRefused)
{
    const std::vector<std::string> lines{"0 0 0 1\n", "1 0 0 1\n", "1 1 0 1\n",
                                         "0 1 0 1\n", "3 0 1 2\n", "3 0 2 3\n"};
    std::string data;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_THAT(
            refusal_of("a.ply", square_ply("ascii", data + "\ncomment none\n")),
            HasSubstr(i < 4
                          ? fmt::format("{} of 4 \"vertex\" lines are there: it is cut off", i)
                          : fmt::format("{} of 2 \"face\" lines are there: it is cut off", i - 4)));
        data += lines[i];
    }
    const TemporaryFolder folder;
    EXPECT_EQ(load_scene_file(folder.write("whole.ply", square_ply("ascii", data)))
                  .scene.triangles.size(),
              2U);
}

TEST(LostTriangles, OfABinaryPlyFileAreRefusedWhereverItIsCut)
{
    for (const bool is_big : {false, true}) {
        const std::string_view format = is_big ? "binary_big_endian" : "binary_little_endian";
        const auto bytes_of = [&](auto value) {
            auto bytes = std::bit_cast<std::array<char, sizeof value>>(value);
            if (is_big) {
                std::ranges::reverse(bytes);
            }
            return std::string(bytes.begin(), bytes.end());
        };
        std::string data;
        for (const auto& [x, y] :
             {std::pair{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
            data += bytes_of(x) + bytes_of(y) + bytes_of(0.0F) + '\1';
        }
        for (const std::array<std::uint16_t, 3>& face :
             {std::array<std::uint16_t, 3>{0, 1, 2}, std::array<std::uint16_t, 3>{0, 2, 3}}) {
            data += '\3' + bytes_of(face[0]) + bytes_of(face[1]) + bytes_of(face[2]);
        }
        const std::size_t step = tests::in_lane<std::size_t>(3, 1);
        for (std::size_t length = 0; length < data.size(); length += step) {
            EXPECT_THAT(refusal_of("a.ply", square_ply(format, data.substr(0, length))),
                        HasSubstr("it is cut off"))
                << format << ", " << length << " bytes of data";
        }
        const TemporaryFolder folder;
        EXPECT_EQ(load_scene_file(folder.write("whole.ply", square_ply(format, data)))
                      .scene.triangles.size(),
                  2U)
            << format;
    }
}

/// An OBJ file of one polygon: the corners of a circle.
std::string circle_obj(int corners)
{
    std::string text;
    std::string face = "f";
    for (int i = 0; i < corners; ++i) {
        const double angle_rad = 6.283185307179586 * i / corners;
        text += fmt::format("v {:.9f} {:.9f} 0\n", std::cos(angle_rad), std::sin(angle_rad));
        face += fmt::format(" {}", i + 1);
    }
    return text + face + "\n";
}

TEST(LargePolygons, AreCutIntoAllTheirTriangles)
{
    // More corners than are tested one by one.
    const int corners = tests::in_lane(20'000, 40'000);
    const TemporaryFolder folder;
    const SceneFile file = load_scene_file(folder.write("a.obj", circle_obj(corners)));
    // Three corners that rounding puts in line have no area.
    EXPECT_EQ(file.scene.triangles.size() + file.scene.dropped_triangles,
              static_cast<std::size_t>(corners - 2));
}

TEST(LargePolygons, AreRefusedBeyondALimitThatIsNamed)
{
    std::string face = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf";
    for (int i = 0; i < 100'001; ++i) {
        face += fmt::format(" {}", i % 3 + 1);
    }
    EXPECT_THAT(refusal_of("a.obj", face + "\n"),
                HasSubstr("face 0: a polygon of 100001 corners is too large, at most 100000 are "
                          "supported; export it as triangles"));
}

} // namespace
} // namespace gnomon::scene
