// Binary PLY files are read correctly, whatever their bytes are.

#include "lane.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene/import/scene_file.hpp"
#include "scene_file_fixture.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon::scene {
namespace {

using test::TemporaryFolder;

/// Writes numbers in one of the two orders of bytes.
class PlyBytes {
public:
    explicit PlyBytes(bool is_big) : is_big_{is_big} {}

    template <typename Number>
    [[nodiscard]] std::string of(Number number) const
    {
        auto bytes = std::bit_cast<std::array<char, sizeof number>>(number);
        if (is_big_) {
            std::ranges::reverse(bytes);
        }
        return {bytes.begin(), bytes.end()};
    }
    [[nodiscard]] std::string_view format() const
    {
        return is_big_ ? "binary_big_endian" : "binary_little_endian";
    }

private:
    bool is_big_;
};

/// The header of a triangle whose x are integers, so that any byte may come first.
/// @param before  elements before the vertices.
std::string header(const PlyBytes& bytes, std::string_view line_end, std::string_view before = "")
{
    std::string text = fmt::format("ply\nformat {} 1.0\ncomment a triangle\n{}element vertex 3\n"
                                   "property int x\nproperty float y\nproperty float z\n"
                                   "element face 1\nproperty list uchar ushort vertex_indices\n"
                                   "end_header\n",
                                   bytes.format(), before);
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;
         at += line_end.size()) {
        text.replace(at, 1, line_end);
    }
    return text;
}

/// (x, 0, 0), (0, 1, 0), (0, 0, 1): never flat.
std::string triangle(const PlyBytes& bytes, std::int32_t x)
{
    const std::string zero = bytes.of(0.0F);
    const std::string one = bytes.of(1.0F);
    const std::string no_x = bytes.of(std::int32_t{0});
    std::string data = bytes.of(x) + zero + zero + no_x + one + zero + no_x + zero + one + '\3';
    for (std::uint16_t corner = 0; corner < 3; ++corner) {
        data += bytes.of(corner);
    }
    return data;
}

void expect_triangle(const std::filesystem::path& file, std::int32_t x, std::string_view what)
{
    const TriangleScene scene = load_scene_file(file).scene;
    ASSERT_EQ(scene.triangles.size(), 1U) << what;
    const std::array<Vec3f, 3> expected{{{static_cast<float>(x), 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    EXPECT_EQ(scene.corners(0), expected) << what;
}

/// Each file is read in its own process. So the usual lane tries every byte after \n only in one
/// byte order; elsewhere, only bytes that may pass for text and both ends of the range.
bool is_tried(bool is_big, std::string_view line_end, unsigned first)
{
    constexpr std::array<unsigned, 6> everywhere{0x00, 0x09, 0x0A, 0x0D, 0x20, 0xFF};
    return tests::runs_full_tests() || std::ranges::find(everywhere, first) != everywhere.end() ||
           (line_end == "\n" && is_big == (first >= 128));
}

class BinaryPly : public ::testing::TestWithParam<bool> {};

TEST_P(BinaryPly, IsReadWhateverItsFirstDataByte)
{
    const TemporaryFolder folder;
    const PlyBytes bytes{GetParam()};
    for (const std::string_view line_end : {"\n", "\r\n"}) {
        for (unsigned first = 0; first < 256; ++first) {
            if (!is_tried(GetParam(), line_end, first)) {
                continue;
            }
            const std::array<std::uint8_t, 4> leading{static_cast<std::uint8_t>(first), 0, 0, 0};
            auto number = std::bit_cast<std::int32_t>(leading);
            if (GetParam()) {
                number = static_cast<std::int32_t>(first << 24U);
            }
            const auto file =
                folder.write("a.ply", header(bytes, line_end) + triangle(bytes, number));
            expect_triangle(file, number,
                            fmt::format("byte {:#04x}, lines of {} bytes", first, line_end.size()));
        }
    }
}

TEST_P(BinaryPly, IsReadBehindElementsThatNobodyKnows)
{
    const TemporaryFolder folder;
    const PlyBytes bytes{GetParam()};
    const std::string_view cameras = "element camera 2\nproperty float focal_length\n"
                                     "property list uchar short lens\n";
    std::string data;
    for (int i = 0; i < 2; ++i) {
        data += bytes.of(35.0F) + '\2' + bytes.of(std::int16_t{7}) + bytes.of(std::int16_t{8});
    }
    const auto file =
        folder.write("a.ply", header(bytes, "\n", cameras) + data + triangle(bytes, 5));
    expect_triangle(file, 5, "cameras");
}

INSTANTIATE_TEST_SUITE_P(Orders, BinaryPly, ::testing::Bool());

} // namespace
} // namespace gnomon::scene
