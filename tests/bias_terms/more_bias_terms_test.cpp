#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/lookup/taps.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/stage_keys.hpp"
#include "compared.hpp"
#include "gl_case.hpp"
#include "methods/job_method.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "methods_job.hpp"
#include "raster_gl/glsl_snippets.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

/// Two additional bias terms, pull and lift of list.cpp: they have the documented effect, appear as
/// causes, and can be swept.
namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Comparison;
using scene::PixelClass;

using Keys = std::vector<scene::Override>;

Keys small(Keys keys)
{
    const Keys size{
        {"image.width", "160"}, {"image.height", "90"}, {"shadow_map.resolution", "128"}};
    keys.insert(keys.begin(), size.begin(), size.end());
    return keys;
}

/// A wall under a coarse map, without the built-in's own bias.
scene::Job wall_with(Keys keys)
{
    keys.insert(keys.begin(), {"bias.constant_m", "0"});
    return tests::builtin_job("wall", small(std::move(keys))).job;
}

scene::View view_of(const scene::Job& job)
{
    const scene::SceneFile file = scene::load_scene(job.scene);
    return scene::resolve_view(job, file.scene, file.defaults);
}

std::string functions_of(const scene::Job& job)
{
    const scene::View view = view_of(job);
    return raster_gl::bias_functions(methods::active_biases(job, view));
}

TEST(MoreBiasTerms, HaveRowsInTheTableOfBiases)
{
    std::vector<std::string> names;
    for (const scene::Key& key : methods::key_table()->rows()) {
        if (key.name.starts_with("bias.")) {
            names.push_back(key.name);
        }
    }
    ASSERT_GT(names.size(), 2U);
    EXPECT_EQ(names.front(), "bias.constant");
    EXPECT_EQ(names[names.size() - 2], "bias.pull_m");
    EXPECT_EQ(names.back(), "bias.lift_m");
    const scene::Key& pull = *methods::key_table()->find("bias.pull_m");
    EXPECT_EQ(pull.unit, "m");
    EXPECT_EQ(pull.default_text, "0");
    EXPECT_EQ(methods::keys_of(methods::methods()[0]).back().name, "bias.lift_m");
    EXPECT_EQ(methods::keys_of(methods::methods()[1]).back().name, "bias.receiver_plane_clamp")
        << "of the house's own terms the last";
}

TEST(MoreBiasTerms, AreOfTheMethodThatListsThem)
{
    const Keys other{{"method.name", "vsm"}, {"bias.pull_m", "0.5"}};
    EXPECT_THROW((void)tests::builtin_job("wall", other), scene::InputError);
    const scene::View view = view_of(tests::builtin_job("wall", {{"method.name", "vsm"}}).job);
    EXPECT_FALSE(view.bias.find_added("bias.pull_m"));
}

TEST(MoreBiasTerms, AreResolvedToFloat32Once)
{
    const scene::View view = view_of(wall_with({{"bias.pull_m", "0.1"}}));
    EXPECT_EQ(view.bias.find_added("bias.pull_m"), 0.1F);
    EXPECT_EQ(view.bias.find_added("bias.lift_m"), 0.0F) << "its default";
    EXPECT_FALSE(view.bias.find_added("bias.slope")) << "is the scene's own";
    EXPECT_THROW((void)wall_with({{"bias.pull_m", "1e-39"}}), scene::InputError);
}

TEST(MoreBiasTerms, AreCompiledWhereAJobSetsThem)
{
    using testing::HasSubstr;
    using testing::Not;
    const std::string none = functions_of(wall_with({}));
    EXPECT_THAT(none, Not(HasSubstr("pull")));
    EXPECT_THAT(none, Not(HasSubstr("lift")));
    EXPECT_THAT(none, Not(HasSubstr("normal_offset")));
    const std::string all = functions_of(
        wall_with({{"bias.lift_m", "1"}, {"bias.pull_m", "1"}, {"bias.normal_texels", "1"}}));
    EXPECT_THAT(all, HasSubstr("r = pull(receiver, r);"));
    EXPECT_THAT(all, HasSubstr("vec4(normal_offset(receiver), 0.0);\n"
                               "    clip = clip + light_clip_from_world[map_index] * "
                               "vec4(lift(receiver), 0.0);\n"));
}

TEST(MoreBiasTerms, NeedALookupOfTheirOwnWithoutBias)
{
    const auto derives = [](const Keys& keys) {
        const scene::Job job = wall_with(keys);
        return analysis::can_derive_unbiased(job, view_of(job));
    };
    EXPECT_TRUE(derives({{"bias.slope", "1"}}));
    EXPECT_TRUE(derives({{"bias.pull_m", "0"}}));
    EXPECT_FALSE(derives({{"bias.pull_m", "0.5"}}));
    EXPECT_FALSE(derives({{"bias.lift_m", "0.5"}}));
    const scene::Job job = wall_with({{"bias.pull_m", "0.5"}, {"bias.lift_m", "0.5"}});
    scene::View view = view_of(job);
    view.bias = {};
    EXPECT_TRUE(analysis::can_derive_unbiased(job, view));
}

TEST(MoreBiasTerms, ChangeTheLookupAlone)
{
    const auto keys = [](const char* pull) {
        return analysis::stage_keys(wall_with({{"bias.pull_m", pull}}));
    };
    const analysis::StageKeys some = keys("0.5");
    const analysis::StageKeys more = keys("0.75");
    EXPECT_EQ(some.truth, more.truth);
    EXPECT_EQ(some.receivers, more.receivers);
    EXPECT_EQ(some.map, more.map);
    EXPECT_NE(some.lookup, more.lookup);
}

/// Both kinds of depth; one tap, several, and a mean.
const std::vector<Keys>& variants()
{
    static const std::vector<Keys> all{
        {},
        {{"shadow_map.reversed", "true"}},
        {{"lookup.filter", "pcf3"}, {"shadow_map.depth_format", "d16"}},
        {{"lookup.filter", "linear"}, {"lookup.position", "pixel"}},
        {{"lookup.filter", "hardware"}}};
    return all;
}

Keys with(Keys keys, const Keys& more)
{
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

// fl(fl(r − p) − 0) is fl(r − fl(p + 0)): without other biases, a pull is a constant bias. The
// length is a float32, so both divide one number by far − near and round once.
TEST(Pull, GivesTheVerdictsOfAConstantBiasInThePlaceOfWhichItStands)
{
    GNOMON_REQUIRE_GL();
    for (const Keys& variant : variants()) {
        const Compared compared{wall_with(variant)};
        const Comparison pulled =
            compared.without_diagnosis(wall_with(with(variant, {{"bias.pull_m", "0.0625"}})));
        const Comparison constant =
            compared.without_diagnosis(wall_with(with(variant, {{"bias.constant_m", "0.0625"}})));
        ASSERT_GT(constant.view.bias.constant, 0);
        const bool reversed = constant.view.first_map().reversed;
        for (std::size_t i = 0; i < constant.lookup.samples.pixel_count(); ++i) {
            if (constant.receivers.triangle[i] == scene::no_triangle) {
                continue;
            }
            const scene::LookupSample& a = pulled.lookup.samples[i];
            const scene::LookupSample& b = constant.lookup.samples[i];
            const float p = constant.view.bias.constant;
            ASSERT_EQ(a.verdict, b.verdict) << "pixel " << i;
            ASSERT_EQ(a.receiver_depth, reversed ? b.receiver_depth + p : b.receiver_depth - p);
            ASSERT_EQ(a.map_depth, b.map_depth);
        }
    }
}

TEST(Pull, IsTheCauseOfWhatItAloneMadeWrong)
{
    GNOMON_REQUIRE_GL();
    for (const Keys& variant : variants()) {
        const Compared compared{wall_with(variant)};
        const Comparison pulled = compared(wall_with(with(variant, {{"bias.pull_m", "0.5"}})));
        const Comparison constant =
            compared(wall_with(with(variant, {{"bias.constant_m", "0.5"}})));
        ASSERT_TRUE(pulled.diagnosis);
        const auto& causes = pulled.diagnosis->causes;
        EXPECT_GT(causes.counts.of(Cause::bias), 100U);
        // The repair of a blocked pixel does not tell which bias made it lit.
        for (std::size_t i = 0; i < causes.cause.pixel_count(); ++i) {
            if (pulled.truth.pixel_class[i] == PixelClass::blocked) {
                ASSERT_EQ(causes.cause[i], constant.diagnosis->causes.cause[i]) << "pixel " << i;
                ASSERT_EQ(causes.label[i], constant.diagnosis->causes.label[i]) << "pixel " << i;
            }
        }
    }
}

TEST(Pull, MakesALitPixelWrongByBias)
{
    GNOMON_REQUIRE_GL();
    const Keys clean{{"bias.constant_m", "0.25"}};
    const Compared compared{wall_with(clean)};
    const Comparison pushed = compared(wall_with({{"bias.pull_m", "-0.25"}}));
    const Comparison unbiased = compared.without_diagnosis(wall_with({}));
    std::size_t by_bias = 0;
    for (std::size_t i = 0; i < pushed.truth.pixel_class.pixel_count(); ++i) {
        const bool is_wrong = !scene::is_lit(pushed.lookup.samples[i].verdict);
        const bool was_right = scene::is_lit(unbiased.lookup.samples[i].verdict);
        if (pushed.truth.pixel_class[i] == PixelClass::lit && is_wrong && was_right) {
            ASSERT_EQ(pushed.diagnosis->causes.cause[i], Cause::bias) << "pixel " << i;
            ++by_bias;
        }
    }
    EXPECT_GT(by_bias, 100U);
}

/// The curve's formulas use r after the terms: GL's lookups with other constant biases agree in
/// every pixel.
TEST(MoreBiasTerms, LeaveTheBiasCurveExact)
{
    GNOMON_REQUIRE_GL();
    const Keys moved{{"bias.pull_m", "0.03"},
                     {"bias.lift_m", "0.02"},
                     {"bias.normal_texels", "0.5"},
                     {"bias.slope", "0.001"}};
    for (const Keys& variant : variants()) {
        const scene::Job job = wall_with(with(variant, moved));
        const Compared compared{job};
        const Comparison comparison = compared(job);
        ASSERT_TRUE(comparison.diagnosis->biases);
        const auto verification = analysis::verify_comparison(comparison, compared.renderers());
        ASSERT_TRUE(verification);
        EXPECT_GT(verification->reruns.size(), 3U);
        for (const auto& rerun : verification->reruns) {
            EXPECT_EQ(rerun.differences, 0U) << "bias " << rerun.bias;
        }
    }
}

// The light falls straight down on the plane, so that uv stays. A lift of 2⁻⁴ m changes clip.z, and
// r by half as much, each rounded in [−1, 1]: r is off by no more than 4 · 2⁻²⁴ from the exact
// lift.
TEST(Lift, MovesTheLookupAlongTheLightAsFarAsItSays)
{
    GNOMON_REQUIRE_GL();
    constexpr double tolerance = 4.0 / (1 << 24);
    const auto job_with = [](const Keys& keys) {
        return tests::builtin_job("tilted-plane", small(keys)).job;
    };
    const Compared compared{job_with({})};
    const Comparison plain = compared.without_diagnosis(job_with({}));
    const Comparison lifted = compared.without_diagnosis(job_with({{"bias.lift_m", "0.0625"}}));
    const double lift = 0.0625 / plain.view.first_map().range_m();
    std::size_t receivers = 0;
    std::size_t made_lit = 0;
    for (std::size_t i = 0; i < plain.lookup.samples.pixel_count(); ++i) {
        const scene::LookupSample& before = plain.lookup.samples[i];
        const scene::LookupSample& after = lifted.lookup.samples[i];
        if (plain.receivers.triangle[i] == scene::no_triangle) {
            continue;
        }
        ++receivers;
        ASSERT_NEAR(after.receiver_depth, double{before.receiver_depth} - lift, tolerance);
        ASSERT_EQ(after.map_depth, before.map_depth) << "the same texel";
        const double margin = double{before.receiver_depth} - lift - double{after.map_depth};
        if (std::abs(margin) > tolerance) {
            ASSERT_EQ(after.verdict, margin < 0 ? 1.0F : 0.0F) << "pixel " << i;
        }
        made_lit += after.verdict > before.verdict ? 1 : 0;
    }
    EXPECT_GT(receivers, 10000U);
    EXPECT_GT(made_lit, 1000U);
}

/// The lookup's own float32: a pull of so many depth units, and a lift along the light, whose unit
/// vector GL normalised in float32: 4 roundings of 2^-24.
TEST(MoreBiasTerms, TellWhatTheyDo)
{
    GNOMON_REQUIRE_GL();
    for (const char* const reversed : {"false", "true"}) {
        const scene::Job job = wall_with(
            {{"bias.pull_m", "0.0625"}, {"bias.lift_m", "0.5"}, {"shadow_map.reversed", reversed}});
        const Comparison comparison = Compared{job}(job);
        ASSERT_TRUE(comparison.diagnosis->terms);
        const auto& terms = *comparison.diagnosis->terms;
        EXPECT_TRUE(terms.gradients.empty());
        const scene::Vec3d towards = -glm::normalize(comparison.view.light.direction);
        const auto pull = static_cast<float>(0.0625 / comparison.view.first_map().range_m());
        for (std::size_t i = 0; i < terms.moved.pixel_count(); ++i) {
            if (comparison.receivers.triangle[i] == scene::no_triangle) {
                ASSERT_EQ(terms.moved[i], scene::Vec4f{0}) << "pixel " << i;
                continue;
            }
            ASSERT_EQ(terms.moved[i].w, pull) << "pixel " << i;
            const scene::Vec3d moved{terms.moved[i]};
            ASSERT_LT(glm::length(moved - 0.5 * towards), 4 * 0x1p-24) << "pixel " << i;
        }
    }
}

TEST(MoreBiasTerms, AreSweptByLookupsAlone)
{
    GNOMON_REQUIRE_GL();
    const std::vector<std::string> pulls{"0", "0.125", "0.5"};
    std::vector<scene::Job> jobs;
    std::vector<analysis::CurveRequest> requests;
    for (const std::string& pull : pulls) {
        jobs.push_back(wall_with({{"bias.pull_m", pull}}));
        requests.push_back(
            {analysis::stage_keys(jobs.back()), {requests.size()}, 160 * 90, 128 * 128, false});
    }
    const Compared compared{jobs.front()};
    const analysis::Renderers& renderers = compared.renderers();
    std::map<std::uint64_t, analysis::ConfigurationResult> rows;
    analysis::SweepHooks hooks;
    hooks.open_scene = [&](const scene::Job&) {
        return analysis::OpenScene{&compared.file(), &renderers};
    };
    hooks.task = [&](std::size_t curve) {
        return analysis::SweepTask{
            fmt::format("{}", curve), jobs[curve], {{curve, jobs[curve].bias}}};
    };
    hooks.record = [&](analysis::FinishedCurve&& finished) {
        for (const auto& row : finished.rows) {
            rows.emplace(row.ordinal, row.result);
        }
    };
    hooks.record_failure = [](auto, const std::string& message, auto) { FAIL() << message; };
    hooks.should_stop = [] { return false; };
    const analysis::PlanCounts counts = run_sweep(analysis::make_plan(requests, 1), hooks);
    EXPECT_EQ(counts.truths, 1U);
    EXPECT_EQ(counts.receiver_passes, 1U);
    EXPECT_EQ(counts.shadow_maps, 1U);
    EXPECT_EQ(counts.lookup_passes, 3U);
    ASSERT_EQ(rows.size(), 3U);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const Comparison alone = compared(jobs[i]);
        EXPECT_EQ(rows.at(i).metrics.false_lit, alone.metrics.false_lit) << pulls[i];
        EXPECT_EQ(rows.at(i).metrics.false_shadow, alone.metrics.false_shadow);
        EXPECT_EQ(rows.at(i).causes->of(Cause::bias),
                  alone.diagnosis->causes.counts.of(Cause::bias));
    }
    EXPECT_GT(rows.at(2).metrics.false_lit, rows.at(0).metrics.false_lit);
}

} // namespace
} // namespace gnomon::tests
