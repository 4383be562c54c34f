#include "light_fixture.hpp"
#include "reference_rt/light/critical_bias.hpp"
#include "reference_rt/light/float_rounding.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

namespace gnomon::reference_rt::test {
namespace {

constexpr float largest = std::numeric_limits<float>::max();
constexpr float smallest = std::numeric_limits<float>::min();

/// Compares bits: +0 differs from −0, and NaN equals itself.
testing::AssertionResult is_same(float found, float expected)
{
    if (std::bit_cast<std::uint32_t>(found) == std::bit_cast<std::uint32_t>(expected)) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure()
           << std::hexfloat << "found " << found << ", expected " << expected;
}

struct Rounding {
    double x;
    float nearest;
};

/// Numbers that are doubles, in every range.
const std::array roundings{
    Rounding{0, 0.0F},
    Rounding{0.1, 0.1F},
    Rounding{-0.7, -0.7F},
    // Ties: 1 and 1 + 2^-22 are even, 1 + 2^-23 is odd; below 1 floats are half as far apart.
    Rounding{1 + 0x1p-24, 1.0F},
    Rounding{1 + 0x3p-24, 1 + 0x1p-22F},
    Rounding{-1 - 0x3p-24, -1 - 0x1p-22F},
    Rounding{1 - 0x1p-25, 1.0F},
    Rounding{0x1p-126, smallest},
    Rounding{0x1.fffffep-127, smallest}, // a tie with the largest subnormal
    Rounding{-0x1.fffffep-127, -smallest},
    Rounding{0x1.fffffdfffffffp-127, 0.0F},
    Rounding{-0x1p-127, 0.0F},
    Rounding{0x1p-149, 0.0F},
    Rounding{-1e-320, 0.0F},
    Rounding{0x1.fffffep127, largest},
    Rounding{0x1.fffffefffffffp127, largest},
    Rounding{0x1.ffffffp127, scene::infinity},
    Rounding{-0x1.ffffffp127, -scene::infinity},
    Rounding{1e300, scene::infinity},
};

TEST(ToNearest, RoundsDoublesAsIeee754Does)
{
    for (const auto& [x, nearest] : roundings) {
        EXPECT_TRUE(is_same(ToNearest::of(x), nearest)) << std::hexfloat << x;
        EXPECT_TRUE(is_same(DepthTerm{x}.nearest_float(), nearest)) << std::hexfloat << x;
        EXPECT_TRUE(is_same(exactly_rounded<ToNearest>(Fraction::number(x)), nearest))
            << std::hexfloat << x;
    }
}

TEST(ToNearest, HasItsBoundariesHalfWay)
{
    EXPECT_EQ(ToNearest::boundary(1, 1 + 0x1p-23F), 1 + 0x1p-24);
    EXPECT_EQ(ToNearest::boundary(0, smallest), 0x1.fffffep-127);
    EXPECT_EQ(ToNearest::boundary(-smallest, 0), -0x1.fffffep-127);
    EXPECT_EQ(ToNearest::boundary(largest, scene::infinity), 0x1.ffffffp127);
    EXPECT_EQ(ToNearest::boundary(-scene::infinity, -largest), -0x1.ffffffp127);
}

TEST(ToNearest, DecidesWhatIsFarCloserToATieThanDoubles)
{
    // Neighbours, and their boundary.
    struct Gap {
        float lower, upper;
        double boundary;
    };
    const std::array gaps{Gap{1, 1 + 0x1p-23F, 1 + 0x1p-24},
                          Gap{-1 - 0x1p-23F, -1, -1 - 0x1p-24},
                          Gap{1 - 0x1p-24F, 1, 1 - 0x1p-25},
                          Gap{0, smallest, 0x1.fffffep-127},
                          Gap{-smallest, 0, -0x1.fffffep-127},
                          Gap{largest, scene::infinity, 0x1.ffffffp127},
                          Gap{-scene::infinity, -largest, -0x1.ffffffp127}};
    const Fraction little{Dyadic{0x1p-600} * Dyadic{0x1p-600}, Dyadic{1}};
    const Fraction negative_little{Dyadic{} - little.numerator, Dyadic{1}};
    for (const auto& [lower, upper, boundary] : gaps) {
        const Fraction tie = Fraction::number(boundary);
        EXPECT_TRUE(is_same(exactly_rounded<ToNearest>(tie - little), lower)) << lower;
        EXPECT_TRUE(is_same(exactly_rounded<ToNearest>(tie - negative_little), upper)) << upper;
    }
}

TEST(ToNearest, TakesQuotientsBeyondAllDoubles)
{
    const Dyadic large = Dyadic{0x1p1000} * Dyadic{0x1p1000};
    EXPECT_TRUE(is_same(exactly_rounded<ToNearest>(Fraction{large, Dyadic{3}}), scene::infinity));
    EXPECT_TRUE(is_same(exactly_rounded<ToNearest>(Fraction{large, Dyadic{-3}}), -scene::infinity));
    EXPECT_TRUE(is_same(exactly_rounded<ToNearest>(Fraction{Dyadic{-3}, large}), 0.0F));
    EXPECT_TRUE(is_same(exactly_rounded<ToNearest>(Fraction{Dyadic{}, Dyadic{-3}}), 0.0F));
}

TEST(CertainlyRounded, IsTheFloatOfTheWholeInterval)
{
    EXPECT_EQ(certainly_rounded<ToNearest>(Interval{1, 0x1p-26}), 1.0F);
    EXPECT_EQ(certainly_rounded<ToNearest>(Interval{1, 0x1p-24}), std::nullopt);
    EXPECT_EQ(certainly_rounded<ToNearest>(Interval{1, scene::infinity}), std::nullopt);
    EXPECT_EQ(certainly_rounded<ToNearest>(Interval{std::nan(""), 0}), std::nullopt);
    EXPECT_EQ(certainly_rounded<ToNearest>(DoubleDouble{1 + 0x1p-24, 0x1p-90, 0x1p-91}),
              1 + 0x1p-23F);
    EXPECT_EQ(certainly_rounded<ToNearest>(DoubleDouble{1 + 0x1p-24, -0x1p-90, 0x1p-91}), 1.0F);
    EXPECT_EQ(certainly_rounded<ToNearest>(DoubleDouble{1 + 0x1p-24, 0x1p-90, 0x1p-89}),
              std::nullopt);
    EXPECT_EQ(certainly_rounded<ToNearest>(DoubleDouble{1 + 0x1p-24, 0, 0x1p-40}), std::nullopt);
}

/// A sun at noon and a camera above see a tilted table whose middle, over (0.5, 0.5), has the given
/// height: with a near plane at 1 m the depth there is (3 − height)/4, reversed (1 + height)/4. The
/// middle of a pixel and that of a texel are exactly there.
struct TiltedTable : LitScene {
    TiltedTable(double height, double added_height, bool reversed, double near_m = 1)
        : LitScene{built(height, added_height),
                   noon(),
                   fixed_frustum(2, near_m, near_m + 4, reversed),
                   4,
                   {32, 32}}
    {
        scene::CameraSettings camera;
        camera.eye = {0.0625, 9, 0.0625};
        camera.target = {0.0625, 0, 0.0625};
        camera.up = {0, 0, -1};
        camera.projection = scene::Projection::orthographic;
        camera.orthographic_height_m = 4; // pixel centres are exactly at multiples of 1/8 m
        view.camera = scene::make_camera(camera);
        receivers[pixel] = table_triangle;
    }
    static scene::LightSettings noon()
    {
        scene::LightSettings light = directional({0, -1, 0});
        light.position = Vec3d{0, 4, 0};
        return light;
    }
    /// The middle's height is the mean of those at x = 0 and 1: half of each summand's double.
    static TriangleScene built(double height, double added_height)
    {
        SceneBuilder builder;
        add_ground(builder, 2, 1, -0.5);
        builder.add("table",
                    std::vector<Vec3d>{
                        {0, 2 * height, 0.5}, {1, 2 * added_height, 1}, {1, 2 * added_height, 0}},
                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
        return builder.take();
    }
    [[nodiscard]] float receiver_depth(int threads = 0) const
    {
        return light_queries(Cull::none, threads)->receiver_depths({&pixel, 1}, {}, nullptr)[0];
    }
    void expect_depths(float expected, int threads = 0) const
    {
        const auto light = light_queries(Cull::none, threads);
        EXPECT_EQ(light->first_hits({&texel, 1}, HitDetail::bounded)[0].triangle, table_triangle);
        EXPECT_TRUE(is_same(receiver_depth(threads), expected));
        EXPECT_TRUE(is_same(light->texel_depths({&texel, 1}, scene::texel_centre)[0], expected));
    }

    static constexpr std::uint32_t table_triangle = 2;
    static constexpr std::size_t pixel = 19 * 32 + 19;
    static constexpr Texel texel{1, 2};
};

TEST(RoundedDepths, AreFloatsWhereTheExactDepthsAre)
{
    for (const bool reversed : {false, true}) {
        SCOPED_TRACE(reversed);
        TiltedTable(1, 0, reversed).expect_depths(0.5F);
        TiltedTable(2, 0, reversed).expect_depths(reversed ? 0.75F : 0.25F);
    }
}

/// Heights at which depths are in the middle of two floats, of which one is `even`.
struct Tie {
    bool reversed;
    double height;
    float even, odd;
    bool has_even_on_top; ///< the even one is what a higher table becomes
};
constexpr std::array ties{
    Tie{false, 0x1p-23, 0.75F, 0.75F - 0x1p-24F, false},
    Tie{false, 0x3p-23, 0.75F - 0x1p-23F, 0.75F - 0x1p-24F, true},
    Tie{true, 0x1p-24, 0.25F, 0.25F + 0x1p-25F, false},
    Tie{true, 0x3p-24, 0.25F + 0x1p-24F, 0.25F + 0x1p-25F, true},
};

TEST(RoundedDepths, TakeTheEvenOneOfTwoEquallyNear)
{
    for (const Tie& tie : ties) {
        SCOPED_TRACE(testing::Message() << "height " << std::hexfloat << tie.height);
        TiltedTable(tie.height, 0, tie.reversed).expect_depths(tie.even);
    }
}

TEST(RoundedDepths, KnowOnWhichSideOfATieTheyAre)
{
    // Doubles tell the first from a tie, twice their precision the second, integers the third.
    for (const double added_height : {0x1p-44, 0x1p-60, 0x1p-110}) {
        for (const Tie& tie : ties) {
            SCOPED_TRACE(testing::Message()
                         << "height " << std::hexfloat << tie.height << " ± " << added_height);
            const float higher = tie.has_even_on_top ? tie.even : tie.odd;
            const float lower = tie.has_even_on_top ? tie.odd : tie.even;
            TiltedTable(tie.height, added_height, tie.reversed).expect_depths(higher);
            TiltedTable(tie.height, -added_height, tie.reversed).expect_depths(lower);
        }
    }
}

TEST(RoundedDepths, AreThoseOfRationalsNearTies)
{
    std::mt19937 random{19};
    for (int i = 0; i < 60; ++i) {
        const bool reversed = random() % 2 == 0;
        const double height = (2 * static_cast<double>(random() % (1U << 21U)) + 1) * 0x1p-23;
        const double added = static_cast<double>(static_cast<int>(random() % 3) - 1) *
                             std::ldexp(1.0, -40 - static_cast<int>(random() % 80));
        SCOPED_TRACE(testing::Message() << "reversed " << reversed << ", height " << std::hexfloat
                                        << height << " + " << added);
        const TiltedTable lit{height, added, reversed};
        lit.expect_depths(
            nearest_float(*matrix_depth(lit.view.first_map(), lit.point(TiltedTable::pixel))));
    }
}

TEST(ReceiverDepths, AreThoseOfRationals)
{
    int tried = 0;
    for_each_case([&](const LitScene& lit) {
        auto pixels = lit.scored_pixels();
        std::ranges::shuffle(pixels, std::mt19937{3}); // answers come in the order of the questions
        const auto depths = lit.light_queries()->receiver_depths(pixels, {}, nullptr);
        ASSERT_EQ(depths.size(), pixels.size());
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            EXPECT_TRUE(is_same(depths[i], nearest_float(*matrix_depth(lit.view.first_map(),
                                                                       lit.point(pixels[i])))))
                << "pixel " << pixels[i];
            ++tried;
        }
    });
    EXPECT_GT(tried, 2000);
}

TEST(TexelDepths, AreThoseOfRationals)
{
    int hits_tried = 0;
    for_each_case([&](const LitScene& lit) {
        auto texels = lit.all_texels();
        std::ranges::shuffle(texels, std::mt19937{4});
        const TexelRays rays{lit.view.first_map(), lit.view.light, lit.resolution};
        const LightDepth light_depth{lit.view.first_map()};
        const MapsOfLight maps{lit.view, lit.resolution};
        const TapDepths taps{lit.triangles, maps};
        for (const Cull cull : {Cull::none, Cull::front, Cull::back}) {
            const auto light = lit.light_queries(cull);
            const auto hits = light->first_hits(texels, HitDetail::bounded);
            const auto depths = light->texel_depths(texels, scene::texel_centre);
            ASSERT_EQ(depths.size(), texels.size());
            for (std::size_t i = 0; i < texels.size(); ++i) {
                SCOPED_TRACE(testing::Message() << "texel " << texels[i].x << ' ' << texels[i].y
                                                << ", cull " << scene::cull_name(cull));
                if (hits[i].triangle == no_triangle) {
                    EXPECT_TRUE(is_same(depths[i], lit.view.first_map().reversed ? 0.0F : 1.0F));
                    continue;
                }
                const ExactTap unknown{texels[i], hits[i].triangle};
                const float expected = nearest_float(tap_depth(lit, unknown));
                EXPECT_TRUE(is_same(depths[i], expected));
                EXPECT_TRUE(is_same(taps.nearest_float(unknown), expected)) << "of no known bound";
                ++hits_tried;
            }
        }
    });
    EXPECT_GT(hits_tried, 3000);
}

/// By how much a pixel's depth is farther than a constant in [0, 1], rounded up.
std::vector<float> excesses_over(const renderers::LightQueries& light,
                                 const std::vector<std::size_t>& pixels,
                                 const std::vector<float>& constants)
{
    std::vector<NearestQuery> queries;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        queries.push_back({pixels[i], {{}, no_triangle, static_cast<double>(constants[i]), 0}});
    }
    return light.critical_biases(std::span{queries}, {});
}

TEST(ReceiverDepths, AreNearestAlsoByTheCriticalBiases)
{
    int tried = 0;
    for_each_case([&](const LitScene& lit) {
        const bool reversed = lit.view.first_map().reversed;
        const auto light = lit.light_queries();
        std::vector<std::size_t> pixels;
        std::vector<float> nearest;
        std::vector<float> nearer; // the next one: r exceeds it by more than half of the gap
        for (const std::size_t pixel : lit.scored_pixels()) {
            const float depth = light->receiver_depths({&pixel, 1}, {}, nullptr)[0];
            if (depth > 0 && depth < 1) {
                pixels.push_back(pixel);
                nearest.push_back(depth);
                nearer.push_back(std::nextafter(depth, reversed ? 2.0F : -1.0F));
            }
        }
        const auto biases = excesses_over(*light, pixels, nearest);
        const auto nearer_biases = excesses_over(*light, pixels, nearer);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            SCOPED_TRACE(testing::Message() << "pixel " << pixels[i]);
            // Half gaps are floats: r exceeds a constant by no more than one iff the bias does not.
            const float beyond = std::nextafter(nearest[i], reversed ? -1.0F : 2.0F);
            EXPECT_LE(biases[i], std::abs(beyond - nearest[i]) / 2);
            const float half_gap = std::abs(nearest[i] - nearer[i]) / 2;
            const bool is_even = std::bit_cast<std::uint32_t>(nearest[i]) % 2 == 0;
            EXPECT_TRUE(nearer_biases[i] > half_gap || (nearer_biases[i] == half_gap && is_even));
            ++tried;
        }
    });
    EXPECT_GT(tried, 1000);
}

TEST(RoundedDepths, AreInTheOrderThatTheCriticalBiasesSay)
{
    int in_order = 0;
    for_each_case([&](const LitScene& lit) {
        const bool reversed = lit.view.first_map().reversed;
        std::mt19937 random{5};
        const auto light = lit.light_queries();
        const auto texels = lit.all_texels();
        const auto hits = light->first_hits(texels, HitDetail::bounded);
        const auto depths = light->texel_depths(texels, scene::texel_centre);
        const auto pixels = lit.scored_pixels();
        const auto receivers = light->receiver_depths(pixels, {}, nullptr);
        std::vector<NearestQuery> queries;
        std::vector<std::size_t> asked;
        for (const std::size_t pixel : pixels) {
            const std::size_t t = random() % texels.size();
            asked.push_back(t);
            queries.push_back(
                {pixel, {texels[t], hits[t].triangle, hits[t].depth, hits[t].depth_error}});
        }
        const auto biases = light->critical_biases(std::span{queries}, {});
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            // r <= d, reversed r >= d, iff the smallest bias is not above 0.
            const float excess =
                reversed ? depths[asked[i]] - receivers[i] : receivers[i] - depths[asked[i]];
            if (excess != 0) {
                EXPECT_EQ(excess > 0, biases[i] > 0)
                    << "pixel " << pixels[i] << ", texel " << texels[asked[i]].x << ' '
                    << texels[asked[i]].y;
                ++in_order;
            }
        }
    });
    EXPECT_GT(in_order, 2000);
}

TEST(ReceiverDepths, LieOutsideTheRangeWhereReceiversDo)
{
    for (const bool reversed : {false, true}) {
        SCOPED_TRACE(reversed);
        const auto depth_at = [&](double height) {
            return TiltedTable{height, 0, reversed}.receiver_depth();
        };
        EXPECT_EQ(depth_at(3.5), reversed ? 1.125F : -0.125F);
        EXPECT_EQ(depth_at(-1.5), reversed ? -0.125F : 1.125F);
    }
}

TEST(ReceiverDepths, AreNoNumberInTheCameraPlaneOfTheLight)
{
    SceneBuilder builder;
    add_ground(builder, 2, 1, 4);
    const LitScene lit{builder.take(), spot({0, 4, 0}, {0, 0, 0}, 90), fixed_frustum(2, 1, 8), 4};
    int tried = 0;
    for (std::size_t pixel = 0; pixel < lit.receivers.pixel_count(); ++pixel) {
        if (lit.receivers[pixel] != no_triangle) {
            EXPECT_TRUE(
                std::isnan(lit.light_queries()->receiver_depths({&pixel, 1}, {}, nullptr)[0]))
                << "pixel " << pixel;
            ++tried;
        }
    }
    EXPECT_GT(tried, 10);
}

TEST(RoundedDepths, AreNotSubnormal)
{
    // The near plane is y = 0, and the depth −y/4 = 2^-126 − n·2^-152.
    for (const auto& [n, expected] :
         {std::pair{0, smallest}, std::pair{3, smallest}, std::pair{4, smallest},
          std::pair{5, 0.0F}, std::pair{1 << 20, 0.0F}}) {
        for (const int threads : {0, 1, 2}) {
            SCOPED_TRACE(testing::Message() << "n = " << n << ", threads " << threads);
            TiltedTable{-0x1p-124 - 0x1p-127, 0x1p-127 + n * 0x1p-150, false, 4}.expect_depths(
                expected, threads);
        }
    }
}

TEST(RoundedDepths, AreTheSameWithAnyNumberOfThreads)
{
    const LightCase light = light_cases().back();
    const LitScene lit{random_sheets(1, false), light.light, light.frustum, 37};
    const auto one = lit.light_queries(Cull::none, 1);
    const auto three = lit.light_queries(Cull::none, 3);
    const auto texels = lit.all_texels();
    const auto pixels = lit.scored_pixels();
    EXPECT_EQ(one->texel_depths(texels, scene::texel_centre),
              three->texel_depths(texels, scene::texel_centre));
    EXPECT_EQ(one->receiver_depths(pixels, {}, nullptr),
              three->receiver_depths(pixels, {}, nullptr));
}

TEST(RoundedDepths, RejectWhatIsOutsideTheMapAndTheImage)
{
    const TiltedTable lit{1, 0, false};
    const auto light = lit.light_queries();
    for (const Texel outside : {Texel{4, 0}, Texel{0, 4}, Texel{-1, 0}, Texel{0, -1}}) {
        EXPECT_THROW((void)light->texel_depths({&outside, 1}, scene::texel_centre),
                     std::invalid_argument);
    }
    const std::size_t beyond = lit.receivers.pixel_count();
    EXPECT_THROW((void)light->receiver_depths({&beyond, 1}, {}, nullptr), std::invalid_argument);
}

} // namespace
} // namespace gnomon::reference_rt::test
