#include "gl_case.hpp"

#include "lane.hpp"
#include "raster_gl/map/map_texture.hpp"
#include "raster_gl/map/raster_planes.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <stdexcept>

/// Depths of measured planes: codes that the shader writes beside their float32 z, colour formats,
/// and units of polygon offset.
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
    // The conversion must be exact: in [½, 1), where most of these planes are, float32 cannot add
    // ½.
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

using tests::GlCase;

constexpr auto colour_names = {"r32f", "r16f", "rgba8"};

void expect_codes_of_their_z(const ShadowMap& map, const std::string& where)
{
    const auto codes = read_codes(*tests::shared_context(), map);
    const auto z = read_unquantised_z(*tests::shared_context(), map);
    const auto depths = read_shader_depths(*tests::shared_context(), map);
    for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
        ASSERT_EQ(codes[i], scene::colour_code(map.format, z[i])) << where << " z " << z[i];
        ASSERT_EQ(std::bit_cast<std::uint32_t>(depths[i]),
                  std::bit_cast<std::uint32_t>(scene::colour_value(map.format, codes[i])))
            << where << " z " << z[i];
    }
}

TEST(ColourFormats, AreTheSameInGlslAndInCpp)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"columns", "lamp-room"}) {
        GlCase c{scene};
        for (const char* format : colour_names) {
            for (const char* reversed : {"false", "true"}) {
                c.set({{"shadow_map.depth_format", format},
                       {"shadow_map.resolution", "400"},
                       {"shadow_map.reversed", reversed}});
                c.draw_shadow_map();
                expect_codes_of_their_z(*c.map,
                                        fmt::format("{} {} reversed {}", scene, format, reversed));
            }
        }
    }
}

TEST(ColourFormats, AreTheSameInGlslAndInCppOfDistances)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"lamp-room"};
    for (const char* format : colour_names) {
        c.set({{"shadow_map.depth_format", format},
               {"shadow_map.resolution", "400"},
               {"shadow_map.content", "distance"}});
        c.draw_shadow_map();
        expect_codes_of_their_z(*c.map, format);
    }
}

/// Depths of every size down to below the smallest half.
TEST(ColourFormats, AreTheSameInGlslAndInCppOfSmallDepths)
{
    GNOMON_REQUIRE_GL();
    scene::MeasuredPlaneSettings settings;
    settings.range = {scene::Projection::perspective, 1e-4, 1e4, true,
                      scene::ClipRange::zero_to_one};
    settings.count = 1 << 16;
    const scene::MeasuredPlanes planes = scene::make_measured_planes(settings);
    RasterPlanes raster{*tests::shared_context(), planes};
    for (const char* name : colour_names) {
        const auto format = scene::depth_format_from_name(name).value();
        float smallest = 1;
        for (const auto& sample : raster.measure(format).samples) {
            ASSERT_EQ(sample.texel.code, scene::colour_code(format, sample.shader_depth)) << name;
            smallest = std::min(smallest, sample.shader_depth);
        }
        EXPECT_LT(smallest, 0x1p-25F) << name; // rounds to 0 as a half
    }
}

/// Depth decides which surface is nearest, not the value of its code.
TEST(ColourFormats, HoldTheSurfacesOfTheMapOfFloats)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"yard", "lamp-room"}) {
        for (const char* content : {"depth", "distance"}) {
            if (scene == std::string{"yard"} && content == std::string{"distance"}) {
                continue; // directional lights have no such content
            }
            const std::vector<scene::Override> keys{{"shadow_map.resolution", "400"},
                                                    {"shadow_map.content", content}};
            GlCase c{scene, keys};
            const auto depths_in = [&](const char* format) {
                auto with_format = keys;
                with_format.push_back({"shadow_map.depth_format", format});
                c.set(with_format);
                c.draw_shadow_map();
                return read_shader_depths(*tests::shared_context(), *c.map);
            };
            const auto floats = depths_in("d32f");
            for (const char* name : colour_names) {
                const auto format = scene::depth_format_from_name(name).value();
                const auto depths = depths_in(name);
                for (std::size_t i = 0; i < depths.pixel_count(); ++i) {
                    ASSERT_EQ(depths[i],
                              scene::colour_value(format, scene::colour_code(format, floats[i])))
                        << scene << " " << content << " " << name << " z " << floats[i];
                }
            }
        }
    }
}

TEST(ColourFormats, AreOneWhereNothingIsAndZeroReversed)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane"};
    for (const char* format : colour_names) {
        for (const auto& [reversed, empty] : {std::pair{"false", 1.0F}, {"true", 0.0F}}) {
            c.set({{"shadow_map.fit", "fixed"}, // beside the scene
                   {"shadow_map.fov_deg", "2"},
                   {"light.target", "[0, 100, 0]"},
                   {"shadow_map.near", "0.1"},
                   {"shadow_map.far", "10"},
                   {"shadow_map.depth_format", format},
                   {"shadow_map.reversed", reversed}});
            c.draw_shadow_map();
            for (const float depth : read_shader_depths(*tests::shared_context(), *c.map)) {
                ASSERT_EQ(depth, empty) << format;
            }
        }
    }
}

TEST(OffsetUnit, IsBetweenOneAndTwoStepsOfEachFormat)
{
    GNOMON_REQUIRE_GL();
    for (const FormatSupport& support : query_depth_formats(*tests::shared_context())) {
        if (!support.supported) {
            continue;
        }
        const auto format = scene::depth_format_from_name(support.name).value();
        const auto units = measure_offset_units(*tests::shared_context(), format);
        ASSERT_EQ(units.size(), 6U) << support.name;
        for (const scene::OffsetUnit& unit : units) {
            // GL's conformance tests accept r in [2^-b, 2·2^-b] for unorm. For float it is
            // 2^(e − 23), and twice that on NVIDIA's driver.
            // float32 pipelines cannot resolve 32 bits: there r is a float's, 2^-24 and more.
            const int bits = std::min(format.bits, 24);
            const double least = format.is_float() ? std::ldexp(1.0, std::ilogb(unit.depth) - 23)
                                                   : std::ldexp(1.0, -format.bits);
            const double most =
                format.is_float() ? (tests::is_mesa() ? 1 : 2) * least : std::ldexp(2.0, -bits);
            // The shift is 1/64 at least, and its ends are off by a float32 step each.
            EXPECT_GE(unit.r, least * (1 - 0x1p-9)) << support.name << " at " << unit.depth;
            EXPECT_LE(unit.r, most * (1 + 0x1p-9)) << support.name << " at " << unit.depth;
        }
    }
}

} // namespace

} // namespace gnomon::raster_gl
