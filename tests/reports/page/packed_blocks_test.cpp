#include "reports/page/packed_blocks.hpp"

#include "example_page.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {
namespace {

std::string encoded(std::string_view text)
{
    return base64(std::as_bytes(std::span{text}));
}

TEST(Base64, GivesTheTextsOfItsStandard)
{
    // RFC 4648, section 10.
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foob"), "Zm9vYg==");
    EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(PackedArray, KeepsEveryBitOfFloats)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<float> values{0.0F, -0.0F, 1e-45F, nan, infinity, -infinity, 0.1F, 0.1F};
    const PackedArray packed = pack(std::span{values});
    const auto bits = unpacked(packed.text, 4, packed.differences);
    ASSERT_EQ(bits.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(bits[i], std::bit_cast<std::uint32_t>(values[i])) << i;
    }
}

TEST(PackedArray, TakesNoDifferencesOfDoubles)
{
    std::vector<double> values;
    for (int i = 0; i < 1000; ++i) {
        values.push_back(i);
    }
    const PackedArray packed = pack(std::span{values});
    EXPECT_EQ(packed.differences, 0);
    EXPECT_EQ(std::bit_cast<double>(unpacked(packed.text, 8, 0).back()), 999.0);
}

TEST(PackedArray, TakesTheDifferencesThatMakeItShortest)
{
    std::vector<std::uint32_t> constant(5000, 7);
    std::vector<std::uint32_t> squares;
    std::mt19937 random{1};
    std::vector<std::uint32_t> noise;
    for (std::uint32_t i = 0; i < 5000; ++i) {
        squares.push_back(i * i);
        noise.push_back(static_cast<std::uint32_t>(random()));
    }
    EXPECT_EQ(pack(std::span{squares}).differences, 2);
    EXPECT_LT(pack(std::span{squares}).text.size(), 200U);
    EXPECT_LT(pack(std::span{constant}).text.size(), 100U);
    EXPECT_EQ(unpacked(pack(std::span{noise}).text, 4, pack(std::span{noise}).differences)[4999],
              noise[4999]);
}

TEST(PackedArray, GivesBackRandomArrays)
{
    std::mt19937 random{20261122};
    for (unsigned round = 0; round < 60; ++round) {
        std::vector<std::uint16_t> values(random() % 700 + 1);
        std::uint16_t value = 0;
        for (std::uint16_t& v : values) {
            value = static_cast<std::uint16_t>(value + random() % (round + 1));
            v = value;
        }
        const PackedArray packed = pack(std::span<const std::uint16_t>{values});
        const auto bits = unpacked(packed.text, 2, packed.differences);
        ASSERT_EQ(bits, (std::vector<std::uint64_t>{values.begin(), values.end()}))
            << "round " << round << ", seed 20261122";
    }
}

TEST(PackedArray, MayBeEmpty)
{
    const PackedArray packed = pack(std::span<const float>{});
    EXPECT_EQ(packed.count, 0U);
    EXPECT_FALSE(packed.text.empty()); // an empty zlib stream
}

TEST(PackedBlocks, StoresEqualArraysOnce)
{
    PackedBlocks blocks;
    const std::vector<std::uint8_t> a{1, 2, 3};
    const std::vector<std::uint8_t> b{3, 2, 1};
    const store::Json first = blocks.add(pack(std::span{a}));
    const store::Json second = blocks.add(pack(std::span{b}));
    const store::Json third = blocks.add(pack(std::span{a}));
    EXPECT_EQ(first["block"], "b0");
    EXPECT_EQ(second["block"], "b1");
    EXPECT_EQ(third, first);
    EXPECT_EQ(first["type"], "u8");
    EXPECT_EQ(first["count"], 3);
    EXPECT_EQ(blocks.texts().size(), 2U);
    blocks.keep_first(1);
    EXPECT_EQ(blocks.byte_count(), blocks.texts().front().size());
}

TEST(PackedBlocks, StoresTextsByADictionary)
{
    PackedBlocks blocks;
    const std::vector<std::string> texts{"d24", "", "d16", "d24"};
    const store::Json column = blocks.add_texts(texts);
    EXPECT_EQ(column["type"], "text");
    EXPECT_EQ(column["dictionary"], store::Json::parse(R"(["d24", "d16"])"));
    EXPECT_EQ(unpacked(blocks.texts().front(), 4, column["delta"].get<int>()),
              (std::vector<std::uint64_t>{0, 0xFFFFFFFF, 1, 0}));
}

} // namespace
} // namespace gnomon::reports
