#include "store/exr/aov.hpp"

#include "example_comparison.hpp"
#include "scene/error.hpp"
#include "store/exr/header.hpp"
#include "store/images/exr.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon::store {
namespace {

using scene::ImageSize;
using scene::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

ImageSize example_size()
{
    return example().comparison.truth.pixel_class.size();
}

/// The bytes of the example's AOV.
std::string example_bytes()
{
    const TemporaryFolder folder;
    write_aov(folder / "layers.exr", example().comparison, example().points);
    return read_text(folder / "layers.exr");
}

Aov read_bytes(const std::string& bytes, ImageSize size = example_size())
{
    const TemporaryFolder folder;
    std::ofstream{folder / "read.exr", std::ios::binary} << bytes;
    return read_aov(folder / "read.exr", size);
}

void expect_refused(const std::string& bytes, const std::string& reason)
{
    try {
        (void)read_bytes(bytes);
        ADD_FAILURE() << "was read; expected: " << reason;
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("read.exr: "), HasSubstr(reason),
                                        HasSubstr("gnomon compare"), Not(HasSubstr("\n"))));
    }
}

/// The offset of an attribute's value.
std::size_t value_of(const std::string& bytes, const std::string& name, const std::string& type)
{
    const std::string key = name + '\0' + type + '\0';
    return bytes.find(key) + key.size() + 4;
}

std::string little_endian(std::int32_t value)
{
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) {
        bytes += static_cast<char>(static_cast<std::uint32_t>(value) >> shift & 0xFFU);
    }
    return bytes;
}

TEST(ReadAov, ReadsWhatWasWritten)
{
    const Aov aov = read_bytes(example_bytes());
    const analysis::Comparison& comparison = example().comparison;
    ASSERT_EQ(aov.pixel_class.size(), example_size());
    for (std::size_t i = 0; i < aov.pixel_class.pixel_count(); ++i) {
        ASSERT_EQ(aov.pixel_class[i], comparison.truth.pixel_class[i]);
        ASSERT_EQ(aov.witness[i], comparison.truth.witness[i]);
        ASSERT_EQ(aov.prim[i], comparison.receivers.triangle[i]);
        ASSERT_EQ(aov.truth[i] >= 0, scene::is_scored(aov.pixel_class[i]));
        const scene::Vec3f& point = example().points[i];
        ASSERT_TRUE(aov.position[i] == point || std::isnan(point.x)) << i;
    }
    EXPECT_EQ(aov.texts.at("scene_hash"), comparison.scene.hash);
    for (const ExactInput& input : exact_inputs(comparison.view)) {
        EXPECT_THAT(aov.texts.at(input.name), testing::StartsWith(input.values[0]));
    }
}

TEST(ReadAov, RefusesWhatIsNoFile)
{
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
    for (const auto& path : {folder / "none.exr", folder.path(), folder / "pipe.exr"}) {
        EXPECT_THROW((void)read_aov(path, example_size()), InputError) << path;
    }
}

TEST(ReadAov, RefusesOtherFormats)
{
    expect_refused("", "the header ends too early");
    expect_refused("\x89PNG\r\n\x1a\n and more", "not an EXR file");
    std::string bytes = example_bytes();
    for (const auto& [flag, text] : {std::pair{'\x02', "tiles or deep pixels"},
                                     {'\x08', "tiles or deep pixels"},
                                     {'\x10', "several parts"},
                                     {'\x01', "an unknown version"}}) {
        bytes[5] = flag;
        expect_refused(bytes, text);
    }
}

TEST(ReadAov, RefusesAnotherSizeBeforeTakingMemory)
{
    const std::string good = example_bytes();
    const std::size_t window = value_of(good, "dataWindow", "box2i");
    for (const auto& [right, bottom, reason] :
         {std::tuple{example_size().width_px, 63, "the image is 97x64 pixels but the job's is"},
          std::tuple{(1 << 20) - 1, (1 << 20) - 1, "the image is 1048576x1048576 pixels"},
          std::tuple{0x7FFFFFFF, 0x7FFFFFFF, "the data window is not an image's"},
          std::tuple{-1, 63, "the data window is not an image's"}}) {
        std::string bytes = good;
        bytes.replace(window + 8, 8, little_endian(right) + little_endian(bottom));
        try {
            (void)read_bytes(bytes);
            ADD_FAILURE() << "was read; expected: " << reason;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    std::string moved = good;
    moved.replace(window, 4, little_endian(-5));
    expect_refused(moved, "the data window is not an image's");
}

TEST(ReadAov, RefusesHugeAttributesAndEndlessNames)
{
    const std::string start = example_bytes().substr(0, 8);
    expect_refused(start + "a\nb" + '\0' + "string" + '\0' + little_endian(-1),
                   "attribute a?b is too large");
    expect_refused(start + std::string(1000, 'a'), "a name in the header is too long");
    expect_refused(start + '\0', "the header has no data window");
    std::string many = start;
    for (int i = 0; i < 5000; ++i) {
        many += std::string{"a"} + '\0' + "int" + '\0' + little_endian(4) + little_endian(i);
    }
    expect_refused(many, "too many attributes");
}

TEST(ReadAov, RefusesTruncatedFiles)
{
    const std::string good = example_bytes();
    for (std::size_t size = 0; size < good.size() - 1; size += 1 + good.size() / 200) {
        EXPECT_THROW((void)read_bytes(good.substr(0, size)), InputError) << size << " bytes";
    }
}

/// Reads files with one flipped bit, which are refused or accepted, but never crash.
TEST(ReadAov, SurvivesDamagedBytes)
{
    const std::string good = example_bytes();
    std::mt19937_64 random{3};
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string bytes = good;
        // Half of the flips are in the header of some 4 kB.
        const std::size_t range =
            i % 2 == 0 ? std::min<std::size_t>(good.size(), 4096) : good.size();
        const std::size_t at = std::uniform_int_distribution<std::size_t>{0, range - 1}(random);
        bytes[at] =
            static_cast<char>(bytes[at] ^ (1 << std::uniform_int_distribution{0, 7}(random)));
        try {
            (void)read_bytes(bytes);
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 50);
}

/// An EXR file with these channels, whose pixels all hold `code`.
std::string encoded(const std::vector<std::pair<std::string, ChannelType>>& names,
                    std::uint32_t code)
{
    std::vector<ExrChannel> channels;
    for (const auto& [name, type] : names) {
        channels.push_back({name, type, [code](std::size_t) { return code; }});
    }
    const auto bytes = encode_exr(example_size(), channels, {});
    std::string text(bytes.size(), '\0');
    std::memcpy(text.data(), bytes.data(), bytes.size());
    return text;
}

TEST(ReadAov, RefusesMissingChannelsAndOtherTypes)
{
    using enum ChannelType;
    expect_refused(encoded({{"class", uint32}, {"truth", float32}, {"prim", uint32}}, 1),
                   "channel witness is missing or of another type");
    expect_refused(
        encoded({{"class", float32}, {"truth", float32}, {"prim", uint32}, {"witness", uint32}}, 1),
        "channel class is missing or of another type");
}

TEST(ReadAov, RefusesUnknownClasses)
{
    using enum ChannelType;
    const std::vector<std::pair<std::string, ChannelType>> names{
        {"class", uint32}, {"truth", float32}, {"prim", uint32}, {"witness", uint32},
        {"P.X", float32},  {"P.Y", float32},   {"P.Z", float32}};
    EXPECT_EQ(read_bytes(encoded(names, 6)).pixel_class[0], scene::PixelClass::blocked);
    expect_refused(encoded(names, 7), "class code 7 is not in 0 to 6");
}

} // namespace
} // namespace gnomon::store
