#include "analysis/tune/tune.hpp"
#include "compared.hpp"
#include "methods/depth/depth_map.hpp"
#include "methods_job.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

/// GL measures the results that `tune` predicts.
namespace gnomon::tests {
namespace {

using analysis::TuneLimits;

bool is_within(const std::optional<double>& rate, double limit)
{
    return !rate || *rate <= limit;
}

analysis::TuneResult tuned(const scene::Job& job, const Compared& compared,
                           const TuneLimits& limits, int cameras = 0)
{
    const auto views =
        analysis::judge_views(job, compared.file(), compared.renderers(), {cameras, 0, {}});
    const analysis::TuneGoal goal{limits.max_shadow_amount_rate, limits.max_light_amount_rate,
                                  limits.max_false_shadow_rate, limits.max_false_lit_rate,
                                  limits.max_resolution_texels};
    return analysis::tune(job, compared.file(), compared.renderers(), views, goal, {});
}

void expect_promise_kept(const scene::Job& job, const TuneLimits& limits)
{
    const Compared compared{job};
    const auto result = tuned(job, compared, limits);
    const std::string label = job.scene.builtin + job.scene.file.string();
    if (!result.nothing.empty()) {
        EXPECT_EQ(compared(job).metrics.pixels.of(scene::PixelClass::lit), 0U) << label;
        return;
    }
    const analysis::TunedSetting& best = result.best();
    const analysis::ViewOutcome& promised = best.bias.outcomes.front();
    const analysis::Metrics& measured = result.measured.metrics;
    EXPECT_EQ(measured.false_shadow, promised.metrics.false_shadow) << label;
    EXPECT_EQ(measured.false_lit, promised.metrics.false_lit) << label;
    EXPECT_EQ(measured.amounts, promised.metrics.amounts) << label;
    const analysis::CauseAmounts& amounts = result.measured.diagnosis->causes.amounts;
    EXPECT_EQ(amounts.shadow_softening, promised.shadow_softening) << label;
    EXPECT_EQ(amounts.light_softening, promised.light_softening) << label;
    EXPECT_EQ(result.measured_views.front().metrics.amounts, measured.amounts) << label;
    if (result.meets_limits()) {
        EXPECT_TRUE(is_within(promised.shadow_rate(), limits.max_shadow_amount_rate)) << label;
        EXPECT_TRUE(is_within(promised.light_rate(), limits.max_light_amount_rate)) << label;
    }
}

scene::Job small_job(const std::string& builtin)
{
    return tests::builtin_job(builtin, {{"image.width", "320"}, {"image.height", "180"}}).job;
}

TEST(Tune, GlMeasuresWhatItPromises)
{
    GNOMON_REQUIRE_GL();
    expect_promise_kept(small_job("wall"), {0.01, 0.01, 1, 1, 1024});
    expect_promise_kept(small_job("sphere-plane"), {1e-6, 1e-6, 1, 1, 256});
}

TEST(Tune, KnowsWhatAFilterSoftensOnPurpose)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job = tests::builtin_job("sphere-plane", {{"image.width", "160"},
                                                               {"image.height", "90"},
                                                               {"lookup.filter", "pcf3"}})
                               .job;
    const Compared compared{job};
    const auto result = tuned(job, compared, {0.0005, 0.002, 1, 1, 512});
    double softening = 0;
    for (const analysis::TunedSetting& setting : result.considered) {
        const analysis::ViewOutcome& outcome = setting.bias.outcomes.front();
        const double soft = outcome.shadow_softening + outcome.light_softening;
        EXPECT_TRUE(soft == 0 || methods::filter_traits(setting.filter).has_fractions());
        softening += soft;
    }
    EXPECT_GT(softening, 0);
}

/// GL measures the predicted result in each view.
TEST(Tune, HoldsInEveryView)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job =
        tests::builtin_job("wall", {{"image.width", "160"}, {"image.height", "90"}}).job;
    const Compared compared{job};
    const TuneLimits limits{0.02, 0.02, 1, 1, 2048};
    const auto result = tuned(job, compared, limits, 3);
    ASSERT_EQ(result.views.size(), 4U);
    EXPECT_EQ(result.views[0].name, "own");
    ASSERT_TRUE(result.meets_limits());
    for (std::size_t i = 0; i < result.views.size(); ++i) {
        const analysis::ViewOutcome& promised = result.best().bias.outcomes.at(i);
        const scene::Job there =
            analysis::with_view_of(analysis::tuned_job(job, result.best()), result.views[i].job);
        const auto metrics = compared.without_diagnosis(there).metrics;
        EXPECT_EQ(metrics.amounts, promised.metrics.amounts) << i;
        EXPECT_EQ(result.measured_views[i].metrics.amounts, promised.metrics.amounts) << i;
        EXPECT_TRUE(meets(promised, limits)) << i;
    }
}

TEST(Tune, StopsAtTheFewestBytesThatMeetTheLimits)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job = small_job("sphere-plane");
    const Compared compared{job};
    const auto result = tuned(job, compared, {0.5, 0.5, 1, 1, 4096});
    ASSERT_TRUE(result.meets_limits());
    EXPECT_EQ(result.best().filter, scene::Filter::nearest) << "the fewest taps";
    EXPECT_EQ(result.best().map.resolution_texels, 256);
    EXPECT_EQ(result.best().cost.map_bytes, 256U * 256 * 2);
    for (const analysis::TunedSetting& setting : result.considered) {
        EXPECT_GE(setting.cost, result.best().cost);
        EXPECT_TRUE(setting.cost != result.best().cost || !setting.meets_limits() ||
                    mean_amount_rate(setting.pooled()) >= mean_amount_rate(result.best().pooled()));
    }
}

/// A sphere on a floor that is 200 times as wide, under the sun. In a map of the whole scene,
/// texels are wider than the sphere's shadow.
TEST(Tune, PlacesMapsWhereTheShadowsAre)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job =
        tests::builtin_job("sphere-plane", {{"image.width", "320"},
                                            {"image.height", "180"},
                                            {"scene.sphere-plane.light", "orthographic"}})
            .job;
    Compared of_file{job};
    scene::SceneFile large = of_file.file();
    for (scene::Vec3f& vertex : large.scene.vertices) {
        if (vertex.y == 0) { // the plane's
            vertex.x *= 200;
            vertex.z *= 200;
        }
    }
    const Compared compared{std::move(large)};
    const auto views = analysis::judge_views(job, compared.file(), compared.renderers(), {});
    const auto result = analysis::tune(job, compared.file(), compared.renderers(), views, {}, {});
    EXPECT_TRUE(result.meets_limits());
    // The largest map of the whole scene has over a hundred times the error.
    EXPECT_LT(mean_amount_rate(result.measured_views.front()), 0.01);
    EXPECT_TRUE(result.best().sets_half_extent ||
                result.best().map.layout == scene::MapLayout::cascades);
}

TEST(LongTune, PromisesAreKeptOnEveryBuiltin)
{
    GNOMON_REQUIRE_GL();
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        expect_promise_kept(small_job(builtin.name), {0.01, 0.02, 1, 1, 2048});
    }
}

TEST(LongTune, PromisesAreKeptOnSharedScenes)
{
    GNOMON_REQUIRE_GL();
    const char* const folder = std::getenv("GNOMON_SHARED_SCENES");
    if (folder == nullptr) {
        GTEST_SKIP() << "GNOMON_SHARED_SCENES is not set";
    }
    for (const char* const mesh : {"bunny.obj", "nefertiti.obj", "suzanne.obj"}) {
        scene::Job job = small_job("sphere-plane");
        job.scene = {};
        job.scene.file = std::filesystem::path{folder} / mesh;
        job.scene.ground = true;
        job.camera.reset();
        job.light = {};
        expect_promise_kept(job, {0.01, 0.02, 1, 1, 2048});
    }
}

/// The bunny, 32 units wide, on y = 0 under a spot far above it.
struct LargeBunny {
    scene::Job job;
    scene::SceneFile file;
};
LargeBunny large_bunny(const std::filesystem::path& folder)
{
    LargeBunny bunny;
    bunny.job = small_job("sphere-plane");
    bunny.job.scene = {};
    bunny.job.scene.file = folder / "bunny.obj";
    bunny.job.camera.reset();
    bunny.job.light = scene::LightSettings{.type = scene::LightType::spot,
                                           .direction = {},
                                           .position = scene::Vec3d{20, 45, 35},
                                           .target = scene::Vec3d{0, 14, 0},
                                           .cone_deg = 60};
    bunny.job.shadow_map = {};
    bunny.file = scene::load_scene(bunny.job.scene);
    const scene::Box box = bunny.file.scene.bounds();
    const double scale = 32 / (box.upper.x - box.lower.x);
    const scene::Vec3d foot{(box.lower.x + box.upper.x) / 2, box.lower.y, 0};
    for (scene::Vec3f& vertex : bunny.file.scene.vertices) {
        vertex = scene::Vec3f{(scene::Vec3d{vertex} - foot) * scale};
    }
    return bunny;
}

TEST(LongTune, PlacesNearAndFarBeforeItSpendsBytes)
{
    GNOMON_REQUIRE_GL();
    const char* const folder = std::getenv("GNOMON_SHARED_SCENES");
    if (folder == nullptr) {
        GTEST_SKIP() << "GNOMON_SHARED_SCENES is not set";
    }
    LargeBunny bunny = large_bunny(folder);
    const scene::Job job = bunny.job;
    const Compared compared{std::move(bunny.file)};
    const auto result = tuned(job, compared, {});
    ASSERT_TRUE(result.meets_limits());
    EXPECT_LE(result.best().cost.map_bytes, std::uint64_t{32} << 20);
}

} // namespace
} // namespace gnomon::tests
