#include "gl_case.hpp"

#include "lane.hpp"
#include "raster_gl/raster_planes.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

/// Codes that the shader writes against the float32 z that it wrote beside them.
namespace gnomon::raster_gl {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// ⌊z·(2^n − 1) + ½⌋ in rationals.
std::uint32_t nearest_code(float z, int bits)
{
    const Rational steps = Rational{z} * ((std::uint64_t{1} << bits) - 1) + Rational{1, 2};
    return static_cast<std::uint32_t>(numerator(steps) / denominator(steps));
}

std::uint32_t float_code(float z, int bits)
{
    const auto largest = static_cast<float>((std::uint64_t{1} << bits) - 1);
    return static_cast<std::uint32_t>(std::floor(z * largest + 0.5F));
}

scene::MeasuredPlanes planes_of_lesson(int count)
{
    scene::MeasuredPlaneSettings settings;
    settings.range = {scene::Projection::perspective, 4, 50, false, {}};
    settings.count = count;
    return scene::make_measured_planes(settings);
}

scene::DepthMeasurement measure(RasterPlanes& raster, const std::string& format)
{
    return raster.measure(scene::depth_format_from_name(format).value());
}

int sample_count()
{
    return tests::in_lane(1 << 13, 1 << 18);
}

TEST(UnormCodes, AreTheExactlyRoundedZOfTheShader)
{
    GNOMON_REQUIRE_GL();
    const scene::MeasuredPlanes planes = planes_of_lesson(sample_count());
    RasterPlanes raster{*tests::shared_context(), planes};
    std::size_t wrong_in_float = 0;
    for (int bits = 8; bits <= 24; ++bits) {
        for (const auto& sample : measure(raster, fmt::format("u{}", bits)).samples) {
            ASSERT_EQ(sample.texel.code, nearest_code(sample.shader_depth, bits))
                << "u" << bits << " z " << sample.shader_depth;
            if (bits == 24) {
                wrong_in_float +=
                    float_code(sample.shader_depth, 24) != sample.texel.code ? 1U : 0U;
            }
        }
    }
    // Why it must be exact: in [½, 1), where most of these planes are, float32 has no ½ to add.
    const double share = static_cast<double>(wrong_in_float) / sample_count();
    RecordProperty("u24_wrong_in_float32", fmt::format("{:.4f}", share));
    EXPECT_GT(share, 0.1);
}

/// How many texels of two formats of equal width differ, and by how many codes at most.
struct Difference {
    std::size_t texels = 0;
    std::size_t differing = 0;
    std::uint32_t largest_codes = 0;
};

Difference difference(RasterPlanes& raster, const std::string& a, const std::string& b)
{
    const auto of_a = measure(raster, a).samples;
    const auto of_b = measure(raster, b).samples;
    Difference result;
    for (std::size_t i = 0; i < of_a.size(); ++i) {
        const std::uint32_t ca = of_a[i].texel.code;
        const std::uint32_t cb = of_b.at(i).texel.code;
        const std::uint32_t codes = ca > cb ? ca - cb : cb - ca;
        ++result.texels;
        result.differing += codes > 0 ? 1 : 0;
        result.largest_codes = std::max(result.largest_codes, codes);
    }
    return result;
}

TEST(UnormCodes, DifferFromGlsOwnFormatsByOneCodeAtMost)
{
    GNOMON_REQUIRE_GL();
    const scene::MeasuredPlanes planes = planes_of_lesson(1 << 16);
    RasterPlanes raster{*tests::shared_context(), planes};
    for (const int bits : {16, 24}) {
        const Difference d = difference(raster, fmt::format("u{}", bits), fmt::format("d{}", bits));
        ASSERT_EQ(d.texels, std::size_t{1 << 16});
        // The same float32 z, converted by the driver to either of the two nearest codes.
        EXPECT_LE(d.largest_codes, 1U) << bits << " bits";
        RecordProperty(fmt::format("u{0}_differs_from_d{0}", bits), std::to_string(d.differing));
        std::printf("u%d against d%d: %zu of %zu texels differ, by at most %u code\n", bits, bits,
                    d.differing, d.texels, d.largest_codes);
    }
}

} // namespace
} // namespace gnomon::raster_gl
