#include "analysis/depth/measured_error.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

namespace gnomon::analysis {
namespace {

const DepthCoding u8 = DepthCoding::unorm(8);

TexelClass class_of(double codes, std::uint32_t code, double bound_codes = 0)
{
    return classify_texel(u8, {codes / 255, bound_codes / 255, code});
}

TEST(TexelClass, TellsTheNearestOfTheTwoNearestCodes)
{
    EXPECT_EQ(class_of(100.25, 100), TexelClass::nearest_code);
    EXPECT_EQ(class_of(100.25, 101), TexelClass::within_format);
    EXPECT_EQ(class_of(100.75, 101), TexelClass::nearest_code);
    EXPECT_EQ(class_of(100.25, 99), TexelClass::outside);
    EXPECT_EQ(class_of(100.25, 102), TexelClass::outside);
}

TEST(TexelClass, WidensByTheDriversBound)
{
    EXPECT_EQ(class_of(100.25, 102, 0.7), TexelClass::outside);
    EXPECT_EQ(class_of(100.25, 102, 0.8), TexelClass::within_model);
    EXPECT_EQ(class_of(100.25, 99, 0.2), TexelClass::outside);
    EXPECT_EQ(class_of(100.25, 99, 0.3), TexelClass::within_model);
}

TEST(TexelClass, ClampsToTheRangeOfDepth)
{
    EXPECT_EQ(class_of(0, 0, 3), TexelClass::nearest_code);
    EXPECT_EQ(class_of(255.2, 255, 0), TexelClass::nearest_code);
    EXPECT_EQ(class_of(254.9, 255, 3), TexelClass::nearest_code);
}

TEST(TexelClass, CountsFloatsInUnitsOfTheLastPlace)
{
    const DepthCoding coding = DepthCoding::float32();
    const auto texel = [](double exact, float stored, double bound) {
        return scene::TexelDepth{exact, bound, std::bit_cast<std::uint32_t>(stored)};
    };
    const double exact = 0.75 + 0.25 * 0x1p-24;
    const float below = 0.75F;
    const float above = std::nextafterf(below, 1);
    EXPECT_EQ(classify_texel(coding, texel(exact, below, 0)), TexelClass::nearest_code);
    EXPECT_EQ(classify_texel(coding, texel(exact, above, 0)), TexelClass::within_format);
    EXPECT_EQ(classify_texel(coding, texel(exact, std::nextafterf(above, 1), 0)),
              TexelClass::outside);
    EXPECT_EQ(classify_texel(coding, texel(exact, std::nextafterf(above, 1), 0x1p-24)),
              TexelClass::within_model);
    EXPECT_EQ(residual_codes(coding, texel(exact, below, 0)), -0.25);
    EXPECT_EQ(classify_texel(coding, texel(0, 0.0F, 0)), TexelClass::nearest_code);
}

TEST(DepthCertificate, CountsEachTexelOnce)
{
    const std::vector<scene::TexelDepth> texels{{100.25 / 255, 0, 100},
                                                {100.25 / 255, 0, 101},
                                                {100.25 / 255, 2.0 / 255, 103},
                                                {100.25 / 255, 0, 110}};
    const DepthCertificate certificate = certify_texels(u8, texels);
    EXPECT_EQ(certificate.texels, 4U);
    for (std::size_t i = 0; i < texel_class_count; ++i) {
        EXPECT_EQ(certificate.counts.at(i), 1U) << i;
    }
    // Residuals ¼, ¾, 2¾ and 9¾ codes: bins up to ½, 1, 4 and 16.
    EXPECT_EQ(certificate.histogram.at(0), 1U);
    EXPECT_EQ(certificate.histogram.at(1), 1U);
    EXPECT_EQ(certificate.histogram.at(3), 1U);
    EXPECT_EQ(certificate.histogram.at(5), 1U);
    EXPECT_NEAR(certificate.largest_residual_codes, 9.75, 1e-12);
    EXPECT_NEAR(certificate.rms_residual_codes, std::sqrt((0.0625 + 0.5625 + 7.5625 + 95.0625) / 4),
                1e-12);
}

TEST(DepthCertificate, OfNothingIsEmpty)
{
    const DepthCertificate certificate = certify_texels(u8, {});
    EXPECT_EQ(certificate.texels, 0U);
    EXPECT_EQ(certificate.rms_residual_codes, 0);
    EXPECT_TRUE(std::isinf(histogram_end_codes(certificate.histogram.size() - 1)));
}

} // namespace
} // namespace gnomon::analysis
