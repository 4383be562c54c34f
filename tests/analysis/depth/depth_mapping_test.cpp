#include "analysis/depth/depth_mapping.hpp"

#include "analysis/depth/depth_coding.hpp"
#include "depth_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gnomon::analysis {
namespace {

using scene::ClipRange;
using scene::Projection;
using test::all_mappings;
using test::lesson_range;

TEST(DepthMapping, RunsFromNearToFar)
{
    for (const DepthMapping& mapping : all_mappings()) {
        const double near_depth = mapping.range().reversed ? 1 : 0;
        EXPECT_EQ(mapping.depth(4), near_depth);
        EXPECT_EQ(mapping.depth(50), 1 - near_depth);
        EXPECT_EQ(mapping.light_distance_m(near_depth), 4);
        EXPECT_EQ(mapping.light_distance_m(1 - near_depth), 50);
    }
}

/// Ranges with the far plane up to 10^12 times as far as the near one, or close behind it.
std::vector<DepthMapping> extreme_mappings()
{
    std::vector<DepthMapping> mappings;
    for (const auto& [near_m, far_m] :
         {std::pair{0.1, 10000.0}, {0.3, 1e6}, {1e-6, 1e6}, {7.0, 7.000001}, {1e3, 1e15}}) {
        for (const auto projection : {Projection::perspective, Projection::orthographic}) {
            for (const bool reversed : {false, true}) {
                mappings.emplace_back(
                    scene::DepthRange{projection, near_m, far_m, reversed, ClipRange::zero_to_one});
            }
        }
    }
    return mappings;
}

const std::vector<DepthCoding> codings{DepthCoding::unorm(8), DepthCoding::unorm(24),
                                       DepthCoding::unorm(32), DepthCoding::float32()};

/// Codes at, next to and between the ends.
std::vector<std::uint32_t> codes_of(const DepthCoding& coding)
{
    const std::uint32_t last = coding.largest_code();
    return {0, 1, 2, last / 7, last / 2, last / 2 + 1, last - last / 9, last - 2, last - 1, last};
}

/// The distance of a code with the 64 significant bits of long double; 1 − t of an integer code is
/// exact.
long double wide_light_distance_m(const DepthMapping& mapping, const DepthCoding& coding,
                                  std::uint32_t code)
{
    const long double largest = coding.largest_code();
    const long double depth =
        coding.is_float() ? static_cast<long double>(coding.depth(code)) : code / largest;
    const long double complement =
        coding.is_float() ? 1 - depth
                          : static_cast<long double>(coding.largest_code() - code) / largest;
    const long double t = mapping.range().reversed ? complement : depth;
    const long double rest = mapping.range().reversed ? depth : complement;
    const long double near_m = mapping.near_m();
    const long double far_m = mapping.far_m();
    return mapping.is_perspective() ? near_m * far_m / (far_m * rest + near_m * t)
                                    : rest * near_m + t * far_m;
}

TEST(DepthMapping, HasNearAndFarExactlyAtTheEndsOfEveryCoding)
{
    for (const DepthMapping& mapping : extreme_mappings()) {
        for (const DepthCoding& coding : codings) {
            const double at_0_m = mapping.light_distance_m(coding.split_depth(0));
            const double at_1_m =
                mapping.light_distance_m(coding.split_depth(coding.largest_code()));
            EXPECT_EQ(at_0_m, mapping.range().reversed ? mapping.far_m() : mapping.near_m());
            EXPECT_EQ(at_1_m, mapping.range().reversed ? mapping.near_m() : mapping.far_m());
        }
    }
}

TEST(DepthMapping, KeepsEveryDigitOfACodesDistance)
{
    for (const DepthMapping& mapping : extreme_mappings()) {
        for (const DepthCoding& coding : codings) {
            for (const std::uint32_t code : codes_of(coding)) {
                const long double exact_m = wide_light_distance_m(mapping, coding, code);
                const double light_distance_m = mapping.light_distance_m(coding.split_depth(code));
                // Positive terms: t, 1 − t, n/f, product, sum and quotient round once each.
                EXPECT_NEAR(static_cast<double>(light_distance_m - exact_m), 0,
                            6 * 0x1p-53 * static_cast<double>(exact_m))
                    << mapping.near_m() << " to " << mapping.far_m() << ", " << coding.bits()
                    << " bits, code " << code;
            }
        }
    }
}

TEST(DepthMapping, ErrorOfAStoredDepthIsTheDifferenceOfItsDistances)
{
    for (const DepthMapping& mapping : extreme_mappings()) {
        for (const DepthCoding& coding : codings) {
            for (const std::uint32_t code : codes_of(coding)) {
                for (const double share : {0.0, 1e-9, 0.1, 0.5, 0.999, 1.0}) {
                    const double light_distance_m =
                        std::lerp(mapping.near_m(), mapping.far_m(), share);
                    const auto difference_m = static_cast<double>(
                        wide_light_distance_m(mapping, coding, code) - light_distance_m);
                    const double larger_m =
                        std::max(light_distance_m, light_distance_m + difference_m);
                    // Δ is off by four roundings of one half of the depth at ζ and one at ζ', the
                    // smaller at ζ: times Aζζ' each is below 2 max(ζ, ζ'). The products add 4, the
                    // distance 6, relative to a result below max(ζ, ζ').
                    EXPECT_NEAR(mapping.stored_error_m(light_distance_m, coding.split_depth(code)),
                                difference_m, 20 * 0x1p-53 * larger_m)
                        << mapping.near_m() << " to " << mapping.far_m() << ", " << coding.bits()
                        << " bits, code " << code << ", light distance " << light_distance_m;
                }
            }
        }
    }
}

TEST(DepthMapping, OfTheLessonIsItsFormula)
{
    // z_ndc = c2 + c1/ζ with c1 = 2nf/(n − f), c2 = (f + n)/(f − n), the textbook lesson's.
    const DepthMapping mapping{lesson_range()};
    const double c1 = 2 * 4.0 * 50 / (4.0 - 50);
    const double c2 = 54.0 / 46;
    for (const double light_distance_m : {4.0, 5.0, 10.0, 25.0, 49.0}) {
        // Three roundings of numbers below 2 each, halved.
        EXPECT_NEAR(mapping.depth(light_distance_m), 0.5 * (c2 + c1 / light_distance_m) + 0.5,
                    4e-16);
    }
}

TEST(DepthMapping, MatchesTheClipRow)
{
    for (const DepthMapping& mapping : all_mappings()) {
        const scene::Vec2d row = scene::clip_depth_row(mapping.range());
        for (const double light_distance_m : {4.0, 7.5, 20.0, 50.0}) {
            const double z_ndc = (row.x * light_distance_m + row.y) /
                                 (mapping.is_perspective() ? light_distance_m : 1);
            const bool halves = mapping.range().clip_range == ClipRange::minus_one_to_one;
            // Coefficients up to 2.4 round thrice.
            EXPECT_NEAR(halves ? 0.5 * z_ndc + 0.5 : z_ndc, mapping.depth(light_distance_m), 2e-15);
        }
    }
}

TEST(DepthMapping, ErrorOfADepthIsExact)
{
    for (const DepthMapping& mapping : all_mappings()) {
        for (const double error : {1e-3, -1e-3, 1e-6, -1e-6}) {
            const double light_distance_m = 20;
            const double moved_m =
                mapping.light_distance_m(mapping.depth(light_distance_m) + error) -
                light_distance_m;
            // The difference of two distances near 20 m, each off by some 1e-16 relative.
            EXPECT_NEAR(mapping.light_distance_error_m(light_distance_m, error), moved_m, 4e-14);
            EXPECT_GE(mapping.largest_light_distance_error_m(light_distance_m, error),
                      std::abs(moved_m) - 4e-14);
        }
    }
}

TEST(DepthMapping, HasNoDistanceForDepthsBehindInfinity)
{
    const DepthMapping mapping{lesson_range()};
    // 1/ζ = 1/n − Ad is 0 at d = 1/(nA).
    EXPECT_TRUE(std::isinf(mapping.light_distance_error_m(50, 0.1)));
}

TEST(DepthMapping, RejectsRangesWithoutExtent)
{
    const auto rejected = [](Projection projection, double near_m, double far_m) {
        EXPECT_THROW((DepthMapping{{projection, near_m, far_m, false, {}}}), std::domain_error)
            << near_m << " to " << far_m;
    };
    for (const auto projection : {Projection::perspective, Projection::orthographic}) {
        rejected(projection, 5, 5);
        rejected(projection, 6, 5);
        rejected(projection, std::nan(""), 5);
        rejected(projection, 1, INFINITY);
    }
    rejected(Projection::perspective, 0, 5);
    rejected(Projection::perspective, -1, 5);
    EXPECT_NO_THROW((DepthMapping{{Projection::orthographic, -1, 5, false, {}}}));
}

/// The range of distances to the light, over far.
DepthMapping of_distances(double near_m, double far_m)
{
    return {scene::MapContent::distance, {Projection::perspective, near_m, far_m, false, {}}};
}

TEST(DistanceMapping, CountsFromTheLight)
{
    const DepthMapping mapping = of_distances(4, 50);
    EXPECT_EQ(mapping.near_m(), 4);
    EXPECT_EQ(mapping.far_m(), 50);
    EXPECT_EQ(mapping.depth(4), 4 / 50.0);
    EXPECT_EQ(mapping.depth(50), 1);
    EXPECT_EQ(mapping.light_distance_m(0.5), 25);
    EXPECT_EQ(mapping.slope_m(4), 50);
    EXPECT_EQ(mapping.slope_m(50), 50);
    EXPECT_EQ(mapping.light_distance_error_m(10, 0.25), 12.5);
}

TEST(DistanceMapping, RefusesRangesThatNoLightHas)
{
    EXPECT_THROW((void)of_distances(-1, 50), std::domain_error);
    EXPECT_THROW((void)of_distances(50, 50), std::domain_error);
    EXPECT_THROW((void)of_distances(std::nan(""), 50), std::domain_error);
    EXPECT_THROW((void)of_distances(1, std::nan("")), std::domain_error);
}

} // namespace
} // namespace gnomon::analysis
