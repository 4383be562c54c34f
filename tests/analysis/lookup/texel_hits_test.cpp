#include "analysis/lookup/texel_hits.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

namespace gnomon::analysis {
namespace {

using scene::Texel;

TEST(TexelIndex, HoldsNothingOfNothing)
{
    EXPECT_TRUE(TexelIndex{{}}.texels().empty());
}

TEST(TexelIndex, NumbersABlockOfFourByFourInARow)
{
    std::vector<Texel> texels;
    for (int y = 40; y < 48; ++y) {
        for (int x = 16; x < 24; ++x) {
            texels.push_back({x, y});
        }
    }
    const TexelIndex index{texels};
    ASSERT_EQ(index.texels().size(), 64U);
    for (std::size_t i = 0; i < 64; ++i) {
        const std::size_t first = i / 16 * 16;
        EXPECT_EQ(index.texels()[i].x / 4, index.texels()[first].x / 4) << i;
        EXPECT_EQ(index.texels()[i].y / 4, index.texels()[first].y / 4) << i;
    }
}

TEST(TexelIndex, KnowsEveryTexelOnceWhateverTheirOrder)
{
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random{seed};
        std::uniform_int_distribution<int> x{0, seed % 2 == 0 ? 40 : 16383};
        std::uniform_int_distribution<int> y{0, 100};
        std::vector<Texel> texels;
        std::set<std::pair<int, int>> distinct;
        for (int i = 0; i < 500; ++i) {
            texels.push_back({x(random), y(random)});
            distinct.emplace(texels.back().x, texels.back().y);
        }
        const TexelIndex index{texels};
        EXPECT_EQ(index.texels().size(), distinct.size());
        for (int i = 0; i < 500; ++i) {
            const Texel texel{x(random), y(random)};
            EXPECT_EQ(index.has(texel), distinct.contains({texel.x, texel.y}))
                << texel.x << ", " << texel.y;
        }
        for (const Texel& texel : texels) {
            ASSERT_TRUE(index.has(texel));
            ASSERT_LT(index[texel], index.texels().size());
            ASSERT_EQ(index.texels()[index[texel]], texel);
        }
    }
}

} // namespace
} // namespace gnomon::analysis
