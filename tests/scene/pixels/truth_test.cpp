// The truth as a share of the light, and a verdict's error.

#include "scene/pixels/truth.hpp"

#include <gtest/gtest.h>

namespace gnomon::scene::test {
namespace {

TEST(LightShare, IsAllOfTheLightOrNoneByClass)
{
    EXPECT_EQ(share_of(PixelClass::lit), (LightShare{1, 1}));
    EXPECT_EQ(share_of(PixelClass::blocked), (LightShare{0, 0}));
    EXPECT_EQ(share_of(PixelClass::indeterminate), (LightShare{0, 1})) << "nothing is known";
    EXPECT_EQ(share_of(PixelClass::indeterminate).middle(), 0.5F);
}

TEST(Truth, HasTheSharesOfItsClassesUnlessItHasItsOwn)
{
    const ImageSize size{2, 1};
    Truth truth{Image<PixelClass>{size}, Image<ClassReason>{size}, Image<std::uint32_t>{size}, {}};
    truth.pixel_class[0] = PixelClass::lit;
    truth.pixel_class[1] = PixelClass::blocked;
    EXPECT_EQ(truth.share(0), (LightShare{1, 1}));
    EXPECT_EQ(truth.share(1), (LightShare{0, 0}));
    truth.shares = Image<LightShare>{size};
    truth.shares[0] = {0.25F, 0.5F};
    EXPECT_EQ(truth.share(0), (LightShare{0.25F, 0.5F}));
}

TEST(ErrorOf, IsTheDistanceFromTheInterval)
{
    const auto error = [](LightShare seen, float verdict) {
        const auto [too_dark, too_bright] = scene::error_of(seen, verdict);
        return std::pair{too_dark, too_bright};
    };
    EXPECT_EQ(error({1, 1}, 0.25F), (std::pair{0.75, 0.0}));
    EXPECT_EQ(error({0, 0}, 0.25F), (std::pair{0.0, 0.25}));
    EXPECT_EQ(error({0.25F, 0.5F}, 0), (std::pair{0.25, 0.0}));
    EXPECT_EQ(error({0.25F, 0.5F}, 1), (std::pair{0.0, 0.5}));
    for (const float within : {0.25F, 0.375F, 0.5F}) {
        EXPECT_EQ(error({0.25F, 0.5F}, within), (std::pair{0.0, 0.0})) << within;
    }
    EXPECT_EQ(scene::error_of({0.5F, 0.5F}, 0.75F).amount(), 0.25);
}

} // namespace
} // namespace gnomon::scene::test
