#include "analysis/sweep/compare.hpp"
#include "analysis/tune/method_tune.hpp"
#include "fake_methods.hpp"
#include "methods/key_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::Cull;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Makes the given number of eight pixels wrong.
TunedSetting wrong_in(std::uint64_t false_shadow, std::uint64_t map_bytes, int taps, bool meets)
{
    TunedSetting setting;
    setting.cost = {map_bytes, taps};
    ClassCounts pixels;
    pixels.total = 8;
    pixels.by_class[static_cast<std::size_t>(scene::PixelClass::lit)] = 8;
    const auto amount = static_cast<double>(false_shadow);
    setting.bias.outcomes.push_back(
        {0, make_metrics(pixels, {false_shadow, 0, {amount, 0}}), 0, 0});
    setting.bias.meets_limits = meets;
    return setting;
}

TEST(IsLessWrong, AsksForLimitsThenAmountsThenBytesThenTaps)
{
    EXPECT_TRUE(is_less_wrong(wrong_in(5, 9, 9, true), wrong_in(0, 1, 1, false)));
    EXPECT_TRUE(is_less_wrong(wrong_in(1, 9, 9, true), wrong_in(2, 1, 1, true)));
    EXPECT_TRUE(is_less_wrong(wrong_in(1, 1, 9, true), wrong_in(1, 2, 1, true)));
    EXPECT_TRUE(is_less_wrong(wrong_in(1, 1, 1, true), wrong_in(1, 1, 2, true)));
    EXPECT_FALSE(is_less_wrong(wrong_in(1, 1, 1, true), wrong_in(1, 1, 1, true)));
}

TEST(IsLessWrong, LeavesOutWhatIsSoftenedOnPurpose)
{
    TunedSetting soft = wrong_in(4, 1, 1, true);
    soft.bias.outcomes.front().shadow_softening = 3;
    EXPECT_TRUE(is_less_wrong(soft, wrong_in(2, 1, 1, true)));
}

TEST(ChangedKeys, AreThoseOfTheSecondThatDiffer)
{
    scene::Job from;
    from.keys = methods::key_table();
    scene::Job to = from;
    EXPECT_THAT(changed_keys(from, to), IsEmpty());
    to.shadow_map.cull = Cull::front;
    to.method.values["bias.slope_kernels"] = 0.5;
    EXPECT_THAT(changed_keys(from, to),
                ElementsAre("shadow_map.cull = \"front\"", "bias.slope_kernels = 0.5"));
}

bool is_triangles(const scene::Job& job)
{
    const auto found = job.method.values.find("method.extrusion");
    return found != job.method.values.end() &&
           found->second == scene::JobValue{std::string{"triangle"}};
}

/// Volumes with sides of every triangle shadow one pixel, others two; index maps shadow five, or
/// three if drawn without front faces.
std::size_t wrong_of(const scene::Job& job)
{
    if (job.method.name == "shadow_volumes") {
        return is_triangles(job) ? 1 : 2;
    }
    return job.shadow_map.cull == Cull::front ? 3 : 5;
}

TuneResult found_by(const FakeWorld& world, const scene::Job& job, const MethodRequest& request,
                    const TuneLimits& limits = no_limits(), const MethodProgress& progress = {})
{
    const Renderers renderers = world.renderers();
    return tune_methods(job, world.file, renderers, world.views(job), limits, request, progress);
}

TEST(TuneMethods, RanksTheLeastWrongSettingOfEach)
{
    FakeWorld world;
    world.wrong = wrong_of;
    const scene::Job job = job_of_sheet();
    const TuneResult result = found_by(world, job, {{"primitive_id", "shadow_volumes"}, {}});
    ASSERT_TRUE(result.methods);
    ASSERT_THAT(result.methods->ranked, SizeIs(2));
    const TunedMethod& first = result.methods->ranked[0];
    const TunedMethod& second = result.methods->ranked[1];
    EXPECT_EQ(first.name, "shadow_volumes");
    EXPECT_EQ(first.best.pooled().metrics.false_shadow, 1U);
    EXPECT_TRUE(is_triangles(tuned_job(job, first.best)));
    EXPECT_EQ(second.name, "primitive_id");
    EXPECT_EQ(second.best.pooled().metrics.false_shadow, 3U);
    EXPECT_EQ(second.best.map.cull, Cull::front);
    EXPECT_EQ(result.best().method->name, "shadow_volumes");
    EXPECT_EQ(result.measured.metrics.false_shadow, 1U);
    EXPECT_THAT(result.methods->passed_over, IsEmpty());
}

TEST(TuneMethods, TriesEachSettingOnceAndNoMoreThanItSaid)
{
    FakeWorld world;
    world.wrong = wrong_of;
    std::size_t said = 0;
    std::size_t told = 0;
    std::uint64_t bytes = 0;
    const TuneResult result =
        found_by(world, job_of_sheet(), {{"primitive_id", "shadow_volumes"}, {}}, no_limits(),
                 {[&](std::size_t methods, std::size_t settings, std::uint64_t max_bytes) {
                      EXPECT_EQ(methods, 2U);
                      said = settings;
                      bytes = max_bytes;
                  },
                  [&](const TunedSetting&) { ++told; }});
    EXPECT_EQ(told, result.considered.size());
    EXPECT_LE(told, said);
    EXPECT_EQ(bytes, 4U << 20U); // the job's own 1024² d24
    EXPECT_EQ(result.methods->ranked[0].settings + result.methods->ranked[1].settings, told);
    EXPECT_EQ(result.methods->ranked[0].settings, 3U); // the start, and two keys of one more value
}

TEST(TuneMethods, PassesOverWhatRefusesTheJobAndSaysWhy)
{
    FakeWorld world;
    scene::Job job = job_of_sheet();
    job.light = scene::LightSettings{};
    job.light->type = scene::LightType::spot;
    job.light->position = scene::Vec3d{1, 5, 1};
    job.light->target = scene::Vec3d{1, 0, 1};
    job.shadow_map.frustum.content = scene::MapContent::distance;
    job.shadow_map.depth_format = scene::float_depth_format;
    const TuneResult result = found_by(world, job, {{"primitive_id", "shadow_volumes"}, {}});
    ASSERT_THAT(result.methods->passed_over, SizeIs(1));
    EXPECT_EQ(result.methods->passed_over[0].method, "primitive_id");
    EXPECT_THAT(result.methods->passed_over[0].reason, HasSubstr("no distances"));
    ASSERT_THAT(result.methods->ranked, SizeIs(1));
}

TEST(TuneMethods, NotesWhatTheDriverRefuses)
{
    FakeWorld world;
    world.wrong = [](const scene::Job& job) -> std::size_t {
        if (job.shadow_map.cull == Cull::back) {
            throw scene::InputError("this driver draws no back faces");
        }
        return 1;
    };
    const TuneResult result = found_by(world, job_of_sheet(), {{"primitive_id"}, {}});
    const auto& refused = result.methods->ranked.at(0).refused;
    ASSERT_THAT(refused, SizeIs(1));
    EXPECT_THAT(refused[0].keys, ElementsAre("shadow_map.cull = \"back\""));
    EXPECT_EQ(refused[0].reason, "this driver draws no back faces");
}

TEST(TuneMethods, PrefersWhatMeetsTheLimits)
{
    FakeWorld world;
    world.wrong = wrong_of;
    TuneLimits limits;
    limits.max_shadow_amount_rate = 0.2; // of seven lit pixels: one
    const TuneResult result =
        found_by(world, job_of_sheet(), {{"primitive_id", "shadow_volumes"}, {}}, limits);
    EXPECT_TRUE(result.meets_limits());
    EXPECT_TRUE(result.methods->ranked[0].best.meets_limits());
    EXPECT_FALSE(result.methods->ranked[1].best.meets_limits());
}

/// Views in which no scored pixel is lit, or only the eighth.
CheckedViews dark_views(const FakeWorld& world, const scene::Job& job, std::uint64_t lit)
{
    CheckedViews views = world.views(job);
    auto& by_class = views.views.front().pixels.by_class;
    by_class[static_cast<std::size_t>(scene::PixelClass::lit)] = lit;
    by_class[static_cast<std::size_t>(scene::PixelClass::blocked)] = 8 - lit;
    return views;
}

TEST(Tune, RecommendsNothingWhereNoPixelIsLit)
{
    const FakeWorld world;
    const scene::Job job = job_of_sheet();
    const Renderers renderers = world.renderers();
    EXPECT_EQ(why_nothing(dark_views(world, job, 1)), "");
    const CheckedViews dark = dark_views(world, job, 0);
    const TuneResult result = tune(job, world.file, renderers, dark, {}, {});
    EXPECT_THAT(result.nothing, HasSubstr("no scored pixel of this view is lit"));
    EXPECT_FALSE(result.meets_limits());
    EXPECT_THAT(result.considered, IsEmpty());
    EXPECT_EQ(
        tune_methods(job, world.file, renderers, dark, {}, {{"primitive_id"}, {}}, {}).nothing,
        result.nothing);
}

TEST(Tune, IsMadeOfAnyViewThatHasALitPixel)
{
    const FakeWorld world;
    const scene::Job job = job_of_sheet();
    CheckedViews views = dark_views(world, job, 0);
    views.views.push_back(dark_views(world, job, 1).own());
    EXPECT_EQ(why_nothing(views), "");
    views.views.pop_back();
    views.views.push_back(views.own());
    EXPECT_THAT(why_nothing(views), HasSubstr("of these 2 views is lit"));
}

TEST(TuneMethods, NeedsBytesWhereTheJobHasNoMap)
{
    const FakeWorld world;
    scene::Job job = job_of_sheet();
    job.method.name = "shadow_volumes";
    EXPECT_THROW((void)found_by(world, job, {{"primitive_id"}, {}}), scene::InputError);
    const TuneResult result = found_by(world, job, {{"primitive_id"}, 1U << 20U});
    // An index and a depth: 8 bytes a texel, with d16 6; 352² and 416² texels fit.
    EXPECT_GE(result.best().map.resolution_texels, 352);
    EXPECT_LE(result.best().cost.map_bytes, 1U << 20U);
}

TEST(TuneMethods, RefusesAJobThatAllOfThemRefuse)
{
    const FakeWorld world;
    try {
        (void)found_by(world, job_of_sheet(), {{"primitive_id"}, 6});
        FAIL();
    } catch (const scene::InputError& refused) {
        EXPECT_THAT(refused.what(),
                    HasSubstr("primitive_id: even its smallest map exceeds the limit on bytes"));
    }
}

TEST(AdviseMethods, AddsARemedyOfEachAndWhatMustGo)
{
    FakeWorld world;
    world.wrong = wrong_of;
    scene::Job job = job_of_sheet();
    job.method.values["bias.slope_kernels"] = 1.0;
    const Renderers renderers = world.renderers();
    Comparison comparison = compare(job, world.file, renderers);
    advise_methods(comparison, world.views(job), world.file, renderers,
                   {{"shadow_volumes", "primitive_id"}, {}}, {});
    ASSERT_THAT(comparison.advice, SizeIs(2));
    EXPECT_EQ(comparison.advice[0].keys.front(),
              "method.name = \"shadow_volumes\" # and remove [shadow_map], [lookup], [bias]");
    EXPECT_EQ(comparison.advice[0].outcome.errors.false_shadow, 1U);
    EXPECT_EQ(comparison.advice[0].measured_by, MeasuredBy::rerun);
    EXPECT_FALSE(comparison.advice[0].bias);
    EXPECT_THAT(comparison.advice[1].keys.front(), HasSubstr("# and remove [bias], lookup.filter"));
    ASSERT_TRUE(comparison.methods_passed_over);
    EXPECT_THAT(*comparison.methods_passed_over, IsEmpty());
}

} // namespace
} // namespace gnomon::analysis
