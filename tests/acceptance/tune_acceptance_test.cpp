#include "analysis/tune.hpp"
#include "compared.hpp"
#include "scene/builtin_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

/// What `tune` promises, GL keeps.
namespace gnomon::tests {
namespace {

using analysis::TuneLimits;

bool is_within(const std::optional<double>& rate, double limit)
{
    return !rate || *rate <= limit;
}

/// A grid of constant biases over [0, 1] around the recommended one, ten times finer than a factor
/// of two.
std::vector<float> grid_around(float bias)
{
    const double centre = bias > 0 ? double{bias} : 1e-4;
    std::vector<float> biases{0.0F};
    for (int i = -60; i <= 60; ++i) {
        biases.push_back(static_cast<float>(std::min(1.0, centre * std::exp2(i / 10.0))));
    }
    return biases;
}

void expect_promise_kept(const scene::Job& job, const TuneLimits& limits, int grid_step)
{
    const Compared compared{job};
    const auto result = analysis::tune(job, compared.file(), compared.renderers(), limits, {});
    const analysis::TunedSetting& best = result.best();
    const std::string label = job.scene.builtin + job.scene.file.string();
    EXPECT_EQ(result.measured.metrics.false_shadow, best.errors.false_shadow) << label;
    EXPECT_EQ(result.measured.metrics.false_lit, best.errors.false_lit) << label;
    EXPECT_EQ(result.measured.metrics.amounts, best.amounts) << label;
    EXPECT_EQ(result.measured.diagnosis->causes.amounts.shadow_softening, best.shadow_softening)
        << label;
    EXPECT_EQ(result.measured.diagnosis->causes.amounts.light_softening, best.light_softening)
        << label;
    if (result.meets_limits) {
        EXPECT_TRUE(is_within(best.shadow_rate, limits.max_shadow_amount_rate)) << label;
        EXPECT_TRUE(is_within(best.light_rate, limits.max_light_amount_rate)) << label;
    }
    scene::Job other = analysis::tuned_job(job, best);
    const auto biases = grid_around(best.constant);
    for (std::size_t i = 0; i < biases.size(); i += static_cast<std::size_t>(grid_step)) {
        other.bias.constant = double{biases[i]};
        const auto metrics = compared.without_diagnosis(other).metrics;
        // No softening: a filter of one comparison.
        const bool meets = is_within(metrics.shadow_amount_rate, limits.max_shadow_amount_rate) &&
                           is_within(metrics.light_amount_rate, limits.max_light_amount_rate);
        if (meets || !result.meets_limits) {
            EXPECT_GE(metrics.false_shadow + metrics.false_lit, best.errors.total())
                << label << ", bias " << biases[i];
        }
    }
}

scene::Job small_job(const std::string& builtin)
{
    return scene::builtin_job(builtin, {{"image.width", "320"}, {"image.height", "180"}}).job;
}

TEST(Tune, GlMeasuresWhatItPromisesAndNoBiasNearbyIsBetter)
{
    GNOMON_REQUIRE_GL();
    expect_promise_kept(small_job("wall"), {0.01, 0.01, 1, 1, 1024}, 8);
    expect_promise_kept(small_job("yard"), {0.01, 0.05, 1, 1, 512}, 8);
    expect_promise_kept(small_job("sphere-plane"), {1e-6, 1e-6, 1, 1, 256}, 8);
}

/// What is promised of a filter whose verdicts are fractions is what GL measures.
void expect_fractions_kept(const char* filter)
{
    const scene::Job job = scene::builtin_job("sphere-plane", {{"image.width", "320"},
                                                               {"image.height", "180"},
                                                               {"lookup.filter", filter}})
                               .job;
    const Compared compared{job};
    const auto result =
        analysis::tune(job, compared.file(), compared.renderers(), {0.001, 0.01, 1, 1, 512}, {});
    const analysis::TunedSetting& best = result.best();
    const analysis::CauseAmounts& amounts = result.measured.diagnosis->causes.amounts;
    EXPECT_EQ(result.measured.metrics.amounts, best.amounts) << filter;
    EXPECT_GT(best.shadow_softening + best.light_softening, 0) << filter;
    EXPECT_EQ(amounts.shadow_softening, best.shadow_softening) << filter;
    EXPECT_EQ(amounts.light_softening, best.light_softening) << filter;
    EXPECT_LT(best.error_amount(), best.amounts.total()) << filter;
}

TEST(Tune, KnowsWhatAFilterSoftensOnPurpose)
{
    GNOMON_REQUIRE_GL();
    expect_fractions_kept("pcf3");
    expect_fractions_kept("hardware");
}

TEST(Tune, StopsAtTheFewestBytesThatMeetTheLimits)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job = small_job("sphere-plane");
    const Compared compared{job};
    const auto result =
        analysis::tune(job, compared.file(), compared.renderers(), {0.5, 0.5, 1, 1, 4096}, {});
    ASSERT_TRUE(result.meets_limits);
    EXPECT_EQ(result.best().map.resolution_texels, 256);
    EXPECT_EQ(analysis::map_bytes(result.best().map), 256U * 256 * 2);
    for (const analysis::TunedSetting& setting : result.considered) {
        EXPECT_EQ(analysis::map_bytes(setting.map), analysis::map_bytes(result.best().map));
        EXPECT_GE(setting.errors.total(), result.best().errors.total());
    }
}

TEST(LongTune, PromisesAreKeptOnEveryBuiltin)
{
    GNOMON_REQUIRE_GL();
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        expect_promise_kept(small_job(builtin.name), {0.01, 0.02, 1, 1, 2048}, 1);
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
        expect_promise_kept(job, {0.01, 0.02, 1, 1, 2048}, 1);
    }
}

} // namespace
} // namespace gnomon::tests
