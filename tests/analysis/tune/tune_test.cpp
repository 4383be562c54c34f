#include "analysis/tune/tune.hpp"
#include "analysis/tune/tuned_setting.hpp"
#include "fake_methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon::analysis {
namespace {

/// A world in which the given number of seven lit pixels is in shadow at any bias. The blocked
/// pixel is lit from a bias of one half on.
FakeWorld world_of(CountWrongPixels wrong)
{
    FakeWorld world;
    world.wrong = std::move(wrong);
    return world;
}

std::unique_ptr<tests::FakeRenderers> depth_renderers(const FakeWorld& world)
{
    auto fake = world.make_fake();
    fake->rasterizer.on_look_up = [&world](const scene::Job& job, const scene::View& view) {
        scene::LookupLayers lookup{scene::Image<scene::LookupSample>{view.image, {0, 0, 0, 1.0F}}};
        for (std::size_t pixel = 0; pixel < world.wrong(job); ++pixel) {
            lookup.samples[pixel] = {1, 0, 0, 0};
        }
        lookup.samples[lookup.samples.pixel_count() - 1] = {0.5F, 0, 0, 0};
        return lookup;
    };
    return fake;
}

TuneResult tuned(const FakeWorld& world, const TuneGoal& goal)
{
    const scene::Job job = job_of_sheet();
    return tune(job, world.file, depth_renderers(world)->renderers(), world.views(job), goal, {});
}

/// One lit pixel is wrong with every map, two more with a map of less than 1024 texels a side.
std::size_t wrong_below_1024(const scene::Job& job)
{
    return job.shadow_map.resolution_texels >= 1024 ? 1 : 3;
}

TEST(Tune, IsAsGoodAsTheLeastWrongSettingAtTheFewestBytes)
{
    const FakeWorld world = world_of(wrong_below_1024);
    const TuneResult result = tuned(world, {});
    EXPECT_TRUE(result.meets_limits());
    EXPECT_EQ(result.relative_limits, 2);
    EXPECT_FALSE(result.is_cut_short);
    EXPECT_EQ(result.best().map.resolution_texels, 1024);
    EXPECT_EQ(result.best().cost.map_bytes, 1024U * 1024 * 2);
    EXPECT_DOUBLE_EQ(result.limits.max_shadow_amount_rate, 1.25 * 1 / 7 + 0.0002);
    EXPECT_DOUBLE_EQ(result.limits.max_light_amount_rate, 0.0002);
    EXPECT_TRUE(std::ranges::any_of(result.considered, [](const TunedSetting& setting) {
        return setting.map.resolution_texels == 4096;
    }));
}

TEST(Tune, HoldsAbsoluteLimitsWhateverIsPossible)
{
    const FakeWorld world = world_of(wrong_below_1024);
    const TuneResult missed =
        tuned(world, {.max_shadow_amount_rate = 0.1, .max_light_amount_rate = 0.1});
    EXPECT_FALSE(missed.meets_limits());
    EXPECT_EQ(missed.relative_limits, 0);
    EXPECT_EQ(missed.limits.max_shadow_amount_rate, 0.1);
    EXPECT_EQ(missed.recommended, missed.least_wrong);
    const TuneResult met =
        tuned(world, {.max_shadow_amount_rate = 0.5, .max_light_amount_rate = 0.1});
    EXPECT_TRUE(met.meets_limits());
    EXPECT_EQ(met.best().cost.map_bytes, 256U * 256 * 2);
}

TEST(Tune, AnswersWithWhatItHasWhenTheTimeIsUp)
{
    const FakeWorld world = world_of(wrong_below_1024);
    double now = 0;
    const TuneGoal goal{.time_s = 10, .seconds = [&] { return now += 4; }};
    const TuneResult result = tuned(world, goal);
    EXPECT_TRUE(result.is_cut_short);
    EXPECT_TRUE(result.meets_limits()) << "of what was tried one is the least wrong";
    // Trials get seven seconds: the job's own setting, and whatever began in time.
    EXPECT_LT(result.considered.size(), tuned(world, {}).considered.size());
    EXPECT_EQ(result.considered.front().map.resolution_texels,
              job_of_sheet().shadow_map.resolution_texels);
}

TEST(Tune, HasARelativeLimitThatTheLeastWrongSettingMeets)
{
    for (std::size_t wrong = 0; wrong < 7; ++wrong) {
        const FakeWorld world = world_of([&](const scene::Job&) { return wrong; });
        // From three on fewer pixels are wrong without any shadow, which is useless.
        EXPECT_EQ(tuned(world, {}).meets_limits(), wrong < 3) << wrong;
    }
}

ViewOutcome outcome_of(std::uint64_t lit, double shadow, std::uint64_t blocked, double light)
{
    ClassCounts pixels;
    pixels.by_class[static_cast<std::size_t>(scene::PixelClass::lit)] = lit;
    pixels.by_class[static_cast<std::size_t>(scene::PixelClass::blocked)] = blocked;
    return {0, make_metrics(pixels, {0, 0, {shadow, light}}), 0, 0};
}

TEST(MeanAmountRate, CountsShadowForHalfHoweverLittleThereIs)
{
    // Compares all shadow of a frame, a hundredth of it, with two hundredths of its lit pixels.
    EXPECT_DOUBLE_EQ(mean_amount_rate(outcome_of(99, 0, 1, 1)), 0.5);
    EXPECT_DOUBLE_EQ(mean_amount_rate(outcome_of(99, 2, 1, 0)), 1.0 / 99);
    EXPECT_DOUBLE_EQ(mean_amount_rate(outcome_of(100, 2, 0, 0)), 0.02);
}

TEST(RelativeLimits, AllowForTheWorstView)
{
    const std::vector<ViewOutcome> views{outcome_of(100, 1, 100, 4), outcome_of(100, 2, 100, 0)};
    const TuneLimits limits = limits_of({.max_false_lit_rate = 0.5}, views);
    EXPECT_DOUBLE_EQ(limits.max_shadow_amount_rate, 1.25 * 0.02 + 0.0002);
    EXPECT_DOUBLE_EQ(limits.max_light_amount_rate, 1.25 * 0.04 + 0.0002);
    EXPECT_EQ(limits.max_false_lit_rate, 0.5);
    EXPECT_EQ(limits_of({.max_light_amount_rate = 0.01}, views).max_light_amount_rate, 0.01);
}

TEST(RelativeLimits, NeverAllowForHalfOfTheShadows)
{
    const std::vector<ViewOutcome> lights_all{outcome_of(100, 0, 100, 100)};
    const TuneLimits limits = limits_of({}, lights_all);
    EXPECT_EQ(limits.max_light_amount_rate, 0.5);
    EXPECT_EQ(limits.max_shadow_amount_rate, relative_limit_spare);
}

} // namespace
} // namespace gnomon::analysis
