#include "analysis/metrics/breakdown.hpp"

#include "analysis/depth/depth_error.hpp"
#include "analysis/results/metric_table.hpp"
#include "scene/infinity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {
namespace {

using PixelClass::blocked;
using PixelClass::lit;
using scene::infinity;
using scene::PixelClass;

const float none = std::nanf("");

struct Pixel {
    PixelClass pixel_class = lit;
    float verdict = 0;
    float critical = 0;
    float light_distance_m = 1;
    float tan_theta = 0;
    float map_error_m = none;
};

struct Images {
    scene::Truth truth;
    scene::LookupLayers lookup;
    scene::Image<float> criticals;
    scene::Image<float> light_distance_m;
    scene::Image<float> map_error_m;

    explicit Images(const std::vector<Pixel>& pixels)
    {
        const scene::ImageSize size{static_cast<int>(pixels.size()), 1};
        truth.pixel_class = scene::Image<PixelClass>{size};
        lookup.samples = scene::Image<scene::LookupSample>{size};
        criticals = light_distance_m = map_error_m = scene::Image<float>{size};
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const Pixel& p = pixels[i];
            truth.pixel_class[i] = p.pixel_class;
            lookup.samples[i] = {0.5F, 0.5F, p.tan_theta, p.verdict};
            criticals[i] = p.critical;
            light_distance_m[i] = p.light_distance_m;
            map_error_m[i] = p.map_error_m;
        }
    }
    [[nodiscard]] BreakdownInputs inputs() const { return {truth, lookup, criticals, map_error_m}; }
    [[nodiscard]] std::vector<ErrorBin> by_distance(int bins = 32) const
    {
        return errors_by_bin(bin_by_distance(truth.pixel_class, light_distance_m, bins), inputs());
    }
    [[nodiscard]] std::vector<ErrorBin> by_angle(int bins = 18) const
    {
        return errors_by_bin(bin_by_angle(truth.pixel_class, lookup, bins), inputs());
    }
};

TEST(ErrorsByDistance, SplitTheObservedRangeEvenly)
{
    const Images images{{{lit, 0, 0.5F, 2.0F, 0, -0.25F},
                         {lit, 1, 0.25F, 2.5F},
                         {blocked, 1, 9.0F, 3.0F},
                         {blocked, 0, 9.0F, 6.0F},
                         {PixelClass::attached, 1, 9.0F, 100.0F}}};
    const auto bins = images.by_distance(4);
    ASSERT_EQ(bins.size(), 4U);
    EXPECT_EQ(bins[0].lower, 2.0);
    EXPECT_EQ(bins[0].upper, 3.0);
    EXPECT_EQ(bins[3].upper, 6.0);
    EXPECT_EQ(bins[0].counts, (SubsetCounts{2, 0, 1, 0, 1, 0}));
    EXPECT_EQ(bins[1].counts,
              (SubsetCounts{0, 1, 0, 1, 0, 1})); // an edge belongs to the bin above it
    EXPECT_EQ(bins[2].counts, SubsetCounts{});
    EXPECT_EQ(bins[3].counts,
              (SubsetCounts{0, 1, 0, 0, 0, 0})); // except that the last bin includes its upper edge
    EXPECT_EQ(bins[0].needed_bias, (Quantiles{2, 0.25F, 0.25F, 0.5F, 0.5F}));
    EXPECT_EQ(bins[0].map_error_m, (Quantiles{1, -0.25F, -0.25F, -0.25F, -0.25F}));
    EXPECT_FALSE(bins[1].needed_bias || bins[1].map_error_m);
}

TEST(ErrorsByDistance, NeedNoRange)
{
    EXPECT_TRUE(Images{{{PixelClass::background}}}.by_distance().empty());
    const auto bins = Images{{{lit}, {lit, 1}}}.by_distance();
    ASSERT_EQ(bins.size(), 1U);
    EXPECT_EQ(bins[0].counts, (SubsetCounts{2, 0, 1, 0, 1, 0}));
}

TEST(ErrorsByDistance, HoldEveryScoredPixelInTheBinOfItsValue)
{
    std::mt19937 random{1};
    std::uniform_real_distribution<float> distance{0.1F, 7.3F};
    for (int repeat = 0; repeat < 20; ++repeat) {
        std::vector<Pixel> pixels(1000);
        for (Pixel& pixel : pixels) {
            pixel.pixel_class = random() % 2 == 0 ? lit : blocked;
            pixel.verdict = static_cast<float>(random() % 2);
            pixel.light_distance_m = distance(random);
        }
        const auto bins = Images{pixels}.by_distance(7);
        std::uint64_t total = 0;
        for (const ErrorBin& bin : bins) {
            const auto expected = std::count_if(pixels.begin(), pixels.end(), [&](const Pixel& p) {
                const bool is_last = bin.upper == bins.back().upper;
                const double light_distance_m{p.light_distance_m};
                return light_distance_m >= bin.lower && (light_distance_m < bin.upper || is_last);
            });
            ASSERT_EQ(bin.counts.lit + bin.counts.blocked, static_cast<std::uint64_t>(expected));
            total += bin.counts.lit + bin.counts.blocked;
        }
        ASSERT_EQ(total, pixels.size());
    }
}

TEST(ErrorsByViewDepth, SplitTheObservedRangeByEqualFactors)
{
    const Images images{{{lit, 0, 0, 0.5F},
                         {lit, 1, 0, 0.99F},
                         {blocked, 1, 0, 1},
                         {blocked, 0.25F, 0, 8},
                         {PixelClass::attached, 1, 0, 100}}};
    const Binning binning = bin_by_view_depth(images.truth.pixel_class, images.light_distance_m, 4);
    // Powers of two: pow and the quotient are exact there.
    for (int i = 0; i <= 4; ++i) {
        EXPECT_EQ(binning.edge(i), std::ldexp(0.5, i)) << i;
    }
    EXPECT_THAT(
        count_by_bin(binning, images.truth, images.lookup, 0),
        ::testing::ElementsAre(
            SubsetCounts{2, 0, 1, 0, 1, 0},
            SubsetCounts{0, 1, 0, 1, 0, 1}, // an edge belongs to the bin above it
            SubsetCounts{},
            SubsetCounts{0, 1, 0, 0, 0, 0.25})); // except that the last bin includes its upper edge
}

TEST(ErrorsByViewDepth, NeedNoRange)
{
    const Images nothing{{{PixelClass::background}}};
    EXPECT_EQ(bin_by_view_depth(nothing.truth.pixel_class, nothing.light_distance_m, 3).bins, 0);
    const Images equal{{{lit, 0, 0, 7}, {lit, 1, 0, 7}}};
    const Binning binning = bin_by_view_depth(equal.truth.pixel_class, equal.light_distance_m, 3);
    ASSERT_EQ(binning.bins, 1);
    EXPECT_EQ(binning.edge(0), 7);
    EXPECT_EQ(binning.edge(1), 7);
    EXPECT_EQ(binning.pixels_of(0).size(), 2U);
}

TEST(ErrorsByViewDepth, HoldEveryScoredPixelInTheBinOfItsValue)
{
    std::mt19937 random{2};
    std::uniform_real_distribution<float> depth{0.01F, 30};
    for (int repeat = 0; repeat < 20; ++repeat) {
        std::vector<Pixel> pixels(1000);
        for (Pixel& pixel : pixels) {
            pixel.light_distance_m = depth(random);
        }
        const Images images{pixels};
        const Binning binning =
            bin_by_view_depth(images.truth.pixel_class, images.light_distance_m, 7);
        ASSERT_EQ(binning.pixels.size(), pixels.size());
        for (int bin = 0; bin < binning.bins; ++bin) {
            for (const std::uint32_t i : binning.pixels_of(static_cast<std::size_t>(bin))) {
                const double depth_m{pixels[i].light_distance_m};
                ASSERT_GE(depth_m, binning.edge(bin));
                ASSERT_TRUE(depth_m < binning.edge(bin + 1) || depth_m == binning.upper);
            }
        }
    }
}

TEST(ErrorsByBin, CountAnyBiasByTheCriticalBiases)
{
    const Images images{{{lit, 0, 0.5F}, {lit, 0, 0.25F}, {blocked, 0, 0.375F}}};
    const std::array<float, 3> biases{0.0F, 0.375F, 0.5F};
    const auto profiles =
        errors_by_bin(bin_by_distance(images.truth.pixel_class, images.light_distance_m),
                      images.inputs(), biases);
    ASSERT_EQ(profiles.size(), 3U);
    EXPECT_EQ(profiles[0][0].counts, (SubsetCounts{2, 1, 2, 0, 2, 0}));
    EXPECT_EQ(profiles[1][0].counts, (SubsetCounts{2, 1, 1, 1, 1, 1}));
    EXPECT_EQ(profiles[2][0].counts, (SubsetCounts{2, 1, 0, 1, 0, 1}));
    EXPECT_EQ(profiles[2][0].needed_bias, profiles[0][0].needed_bias);
}

TEST(ErrorsByBin, AddUpFractions)
{
    const Images images{{{lit, 8.0F / 9}, {lit, 1}, {blocked, 2.0F / 9}, {blocked, 1}}};
    const Binning binning = bin_by_distance(images.truth.pixel_class, images.light_distance_m);
    BreakdownInputs inputs = images.inputs();
    inputs.taps = 9;
    EXPECT_EQ(errors_by_bin(binning, inputs)[0].counts,
              (SubsetCounts{2, 2, 0, 1, 1.0 / 9, 11.0 / 9}));
    // By the taps that are lit at a bias; ignores the lookup's own verdicts.
    const std::array<float, 1> biases{0.0F};
    std::vector<scene::Image<std::uint8_t>> lit_taps{scene::Image<std::uint8_t>{{4, 1}}};
    lit_taps[0][0] = 9;
    lit_taps[0][1] = 7;
    lit_taps[0][3] = 5;
    const SubsetCounts counts = errors_by_bin(binning, inputs, biases, lit_taps)[0][0].counts;
    EXPECT_EQ(counts.shadow_amount, 2.0 / 9);
    EXPECT_EQ(counts.light_amount, 5.0 / 9);
}

TEST(SubsetRates, NameTheirDenominators)
{
    const SubsetCounts counts{4, 0, 1, 0, 1.5, 0};
    std::vector<std::optional<double>> rates;
    for (const SubsetRate& rate : subset_rates()) {
        rates.push_back(rate_of(rate, counts));
    }
    // false shadow, false lit, both; their amounts: per lit, blocked, scored pixel.
    const std::optional<double> no_rate;
    EXPECT_THAT(rates, ::testing::ElementsAre(0.25, no_rate, 0.25, 0.375, no_rate, 0.375));
}

TEST(ErrorsByAngle, SplitTheQuarterTurnEvenly)
{
    const Images images{{{lit, 0, 0, 1, 0.0F}, {lit, 0, 0, 1, 0.9F}, {blocked, 1, 0, 1, 3.0e38F}}};
    const auto bins = images.by_angle();
    ASSERT_EQ(bins.size(), 18U);
    EXPECT_EQ(bins[0].counts, (SubsetCounts{1, 0, 1, 0, 1, 0}));
    EXPECT_EQ(bins[8].counts, (SubsetCounts{1, 0, 1, 0, 1, 0})); // atan 0.9 = 41.99 degrees
    EXPECT_EQ(bins[17].counts, (SubsetCounts{0, 1, 0, 1, 0, 1}));
    EXPECT_DOUBLE_EQ(bins[8].lower, 40 * std::numbers::pi / 180);
    EXPECT_DOUBLE_EQ(bins[17].upper, std::numbers::pi / 2);
}

TEST(ErrorsByObject, ListEveryObjectInOrder)
{
    scene::SceneBuilder builder;
    const std::vector<scene::Vec3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
    const std::vector<std::array<std::uint32_t, 3>> two{{0, 2, 1}, {1, 2, 3}};
    for (const char* name : {"ground", "box", "unseen"}) {
        builder.add(name, corners, two);
    }
    const scene::TriangleScene scene = builder.take();
    const Images images{{{lit, 0}, {blocked, 1}, {lit, 1}, {PixelClass::background}}};
    scene::Image<std::uint32_t> triangles{{4, 1}, scene::no_triangle};
    triangles[0] = 1;
    triangles[1] = 2;
    triangles[2] = 3;
    const auto errors = errors_by_object(images.truth, images.lookup, triangles, scene, 1);
    ASSERT_EQ(errors.size(), 3U);
    EXPECT_EQ(errors[0].name, "ground");
    EXPECT_EQ(errors[0].counts, (SubsetCounts{1, 0, 1, 0, 1, 0}));
    EXPECT_EQ(errors[1].name, "box");
    EXPECT_EQ(errors[1].counts, (SubsetCounts{1, 1, 0, 1, 0, 1}));
    EXPECT_EQ(errors[2].counts, SubsetCounts{});
}

TEST(Breakdown, RejectsWhatItCannotBin)
{
    const Images images{{{lit}}};
    EXPECT_THROW((void)images.by_distance(0), std::invalid_argument);
    EXPECT_THROW((void)images.by_angle(255), std::invalid_argument);
    const Images nowhere{{{lit, 0, 0, infinity}}};
    EXPECT_THROW((void)nowhere.by_distance(), std::invalid_argument);
    EXPECT_THROW((void)errors_by_object(images.truth, images.lookup, {}, {}, 1),
                 std::invalid_argument);
    const scene::Image<float> empty;
    const Binning binning = bin_by_distance(images.truth.pixel_class, images.light_distance_m);
    const BreakdownInputs uneven{images.truth, images.lookup, empty, empty};
    EXPECT_THROW((void)errors_by_bin(binning, uneven), std::invalid_argument);
    EXPECT_THROW((void)bin_by_distance(images.truth.pixel_class, empty), std::invalid_argument);
    EXPECT_THROW((void)bin_by_view_depth(images.truth.pixel_class, empty, 4),
                 std::invalid_argument);
    EXPECT_THROW((void)bin_by_view_depth(images.truth.pixel_class, images.light_distance_m, 0),
                 std::invalid_argument);
    EXPECT_THROW((void)bin_by_view_depth(nowhere.truth.pixel_class, nowhere.light_distance_m, 4),
                 std::invalid_argument);
    const Images behind{{{lit, 0, 0, 0}}};
    EXPECT_THROW((void)bin_by_view_depth(behind.truth.pixel_class, behind.light_distance_m, 4),
                 std::invalid_argument);
    EXPECT_THROW((void)count_by_bin(binning, images.truth, {}, 1), std::invalid_argument);
    const BreakdownInputs no_map_errors{images.truth, images.lookup, images.criticals, empty};
    EXPECT_FALSE(errors_by_bin(binning, no_map_errors)[0].map_error_m.has_value());
}

TEST(BinEnvelopes, AreTheFormulasBetweenNearAndFar)
{
    scene::LightFrustum frustum;
    frustum.projection = scene::Projection::perspective;
    frustum.near_m = 4;
    frustum.far_m = 50;
    std::vector<ErrorBin> bins(3);
    bins[0].upper = 3;
    bins[1].upper = 50;
    bins[2].upper = 60;
    add_envelopes(bins, {&frustum, 1}, {scene::DepthFormat::Kind::d16, 16});
    // The table of docs/depth_precision.md, to its digits.
    EXPECT_NEAR(bins[0].envelope_m.value(), 2.81e-5, 0.005e-5);
    EXPECT_NEAR(bins[1].envelope_m.value(), 4.3874e-3, 0.00005e-3);
    EXPECT_EQ(bins[2].envelope_m, bins[1].envelope_m);
}

TEST(BinEnvelopes, HoldForTheWholeBinWhereTheFormulaFalls)
{
    scene::LightFrustum frustum;
    frustum.projection = scene::Projection::perspective;
    frustum.near_m = 4;
    frustum.far_m = 50;
    frustum.reversed = true;
    frustum.clip_range = scene::ClipRange::zero_to_one;
    const DepthMapping mapping{frustum.depth_range()};
    std::vector<ErrorBin> bins(1);
    bins[0].lower = 30;
    bins[0].upper = 50;
    add_envelopes(bins, {&frustum, 1}, {scene::DepthFormat::Kind::d32f, 32});
    EXPECT_GE(bins[0].envelope_m.value(), error_envelope_m(mapping, DepthCoding::float32(), 30));
    EXPECT_GT(bins[0].envelope_m.value(),
              10 * error_envelope_m(mapping, DepthCoding::float32(), 49.9));
}

TEST(BinEnvelopes, AreConstantForAnOrthographicMap)
{
    scene::LightFrustum frustum;
    frustum.near_m = -1;
    frustum.far_m = 3;
    std::vector<ErrorBin> bins(2);
    bins[0].upper = 0;
    bins[1].upper = 3;
    add_envelopes(bins, {&frustum, 1}, {scene::DepthFormat::Kind::unorm, 8});
    EXPECT_DOUBLE_EQ(bins[0].envelope_m.value(), 0.5 / 255 * 4);
    EXPECT_DOUBLE_EQ(bins[1].envelope_m.value(), 0.5 / 255 * 4);
}

} // namespace
} // namespace gnomon::analysis
