// A plan's steps with renderers that need neither GL nor Embree.

#include "analysis/sweep/runner.hpp"

#include "analysis/sweep/catalogue.hpp"
#include "scene/error.hpp"
#include "scene/job_source.hpp"
#include "sweep_world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

template <typename Value>
std::string text_of(const std::optional<Value>& value)
{
    return value ? fmt::format("{}", *value) : "none";
}

std::string text_of(const std::optional<Quantiles>& value)
{
    return value ? fmt::format("{} {} {} {} {}", value->count, value->min, value->median,
                               value->p95, value->max)
                 : "none";
}

/// Everything that a row says; equal texts are equal results, bit by bit.
std::string text_of(const ConfigurationResult& result)
{
    const Metrics& metrics = result.metrics;
    return fmt::format("{} | {} | {} {} {} {} {} {} | {} | {} | {} | {}", metrics.pixels.by_class,
                       metrics.pixels.by_reason, metrics.false_shadow, metrics.false_lit,
                       text_of(metrics.false_shadow_rate), text_of(metrics.false_lit_rate),
                       text_of(metrics.error_rate), text_of(metrics.mean_abs_error),
                       result.causes ? fmt::format("{}", result.causes->by_cause) : "none",
                       result.causes ? fmt::format("{}", result.causes->by_label) : "none",
                       text_of(result.peter_panning.metres), text_of(result.peter_panning.texels));
}

std::string text_of(const std::vector<ErrorBin>& bins)
{
    std::string text;
    for (const ErrorBin& bin : bins) {
        text += fmt::format("[{} {}: {} {} {} {} | {} | {}]", bin.lower, bin.upper, bin.counts.lit,
                            bin.counts.blocked, bin.counts.false_shadow, bin.counts.false_lit,
                            text_of(bin.needed_bias), text_of(bin.map_error_m));
    }
    return text;
}

/// A sweep of the fake world, and what it told.
class FakeSweep {
public:
    SweepWorld world;
    SweepHooks hooks;
    scene::SweepSpace space;
    std::map<std::uint64_t, std::string> done;   ///< results by ordinal
    std::map<std::uint64_t, std::string> failed; ///< messages by ordinal
    std::map<std::string, CurveResult> curves;   ///< by their id
    std::vector<std::uint64_t> kept;
    PlanCounts planned;
    std::size_t slots = 2;

    explicit FakeSweep(const std::vector<std::string>& axes,
                       const std::vector<scene::Override>& overrides = {},
                       const std::vector<scene::CaseLayer>& cases = {})
        : space{source(overrides, cases), axes}
    {
        hooks.open_scene = [this](const scene::Job&) {
            return OpenScene{&world.file(), &world.renderers()};
        };
        hooks.record = [this](const FinishedCurve& finished) {
            for (const FinishedCurve::Row& row : finished.rows) {
                EXPECT_TRUE(done.emplace(row.ordinal, text_of(row.result)).second) << row.ordinal;
            }
            EXPECT_FALSE(finished.rows.empty());
            curves.insert_or_assign(finished.curve.id, finished.curve);
        };
        hooks.record_failure = [this](std::span<const std::uint64_t> ordinals,
                                      const std::string& message) {
            for (const std::uint64_t ordinal : ordinals) {
                EXPECT_TRUE(failed.emplace(ordinal, message).second) << ordinal << " failed twice";
            }
        };
        hooks.should_stop = [] { return false; };
    }

    void keep_pixels()
    {
        hooks.keep_pixels = [this](std::uint64_t ordinal, const Comparison& comparison) {
            EXPECT_EQ(scene::resolved_keys(comparison.job),
                      scene::resolved_keys(space.job(space.at(ordinal))));
            kept.push_back(ordinal);
        };
    }

    PlanCounts run()
    {
        const SweepCatalogue catalogue{space, static_cast<bool>(hooks.keep_pixels), "1.0"};
        const auto& requests = catalogue.requests();
        const SweepPlan plan = make_plan(requests, slots);
        planned = plan.counts(requests);
        hooks.task = [&](std::size_t curve) { return catalogue.task(curve, "hash"); };
        return run_sweep(plan, hooks);
    }

    /// What `compare` says of the configuration, in a world of its own.
    [[nodiscard]] Comparison compared(std::uint64_t ordinal) const
    {
        const SweepWorld other;
        Comparison comparison =
            compare(space.job(space.at(ordinal)), other.file(), other.renderers());
        comparison.triangles = &world.file().scene;
        return comparison;
    }
    [[nodiscard]] std::size_t calls(std::string_view stage) const
    {
        return static_cast<std::size_t>(
            std::count(world.calls.begin(), world.calls.end(), std::string{stage}));
    }

private:
    static scene::JobSource source(const std::vector<scene::Override>& overrides,
                                   const std::vector<scene::CaseLayer>& cases)
    {
        scene::JobSource source = scene::builtin_job_source("wall", overrides);
        for (const scene::Setting& setting :
             scene::layer_from_overrides({{"camera.target", "[0, 0, 0]"},
                                          {"camera.up", "[0, 0, 1]"},
                                          {"light.direction", "[0, -1, 0]"},
                                          {"image.width", "9"},
                                          {"image.height", "7"},
                                          {"shadow_map.near", "-2"},
                                          {"shadow_map.resolution", "6"},
                                          {"bias.constant", "0"}})) {
            source.file.push_back(setting);
        }
        source.cases = cases;
        if (cases.empty()) {
            source.file.push_back(scene::layer_from_overrides({{"camera.eye", "[0, 5, 0]"}})[0]);
        }
        return source;
    }
};

scene::CaseLayer case_of(const std::string& name, const std::vector<scene::Override>& keys)
{
    return {name, scene::layer_from_overrides(keys)};
}

const std::vector<scene::CaseLayer> two_cameras{case_of("left", {{"camera.eye", "[1, 5, 0]"}}),
                                                case_of("right", {{"camera.eye", "[2, 6, 0]"}})};

std::string result_text(const Comparison& comparison)
{
    return text_of(ConfigurationResult{comparison.metrics, comparison.diagnosis->causes.counts,
                                       comparison.diagnosis->peter_panning});
}

/// Every row is what a comparison of its own gives.
void expect_compared(const FakeSweep& sweep)
{
    EXPECT_EQ(sweep.done.size() + sweep.failed.size(), sweep.space.size());
    for (const auto& [ordinal, text] : sweep.done) {
        EXPECT_EQ(text, result_text(sweep.compared(ordinal))) << "ordinal " << ordinal;
    }
}

TEST(SweepRunner, RunsEachStageAsOftenAsPlanned)
{
    FakeSweep sweep{{"shadow_map.near=-2,-1", "shadow_map.resolution=4,8", "bias.slope=0,0.25",
                     "bias.constant=0,0.125,0.25"},
                    {},
                    two_cameras};
    const PlanCounts counts = sweep.run();
    EXPECT_EQ(counts, (PlanCounts{48, 1, 2, 4, 4, 8, 16}));
    EXPECT_EQ(counts, sweep.planned);
    EXPECT_EQ(sweep.calls("truth"), 2U);
    EXPECT_EQ(sweep.calls("receivers"), 4U);
    EXPECT_EQ(sweep.calls("map"), 4U);
    EXPECT_EQ(sweep.calls("lookup"), 8U);
    EXPECT_THAT(sweep.failed, IsEmpty());
    expect_compared(sweep);
}

TEST(SweepRunner, GivesWhatAComparisonGives)
{
    for (const char* const reversed : {"false", "true"}) {
        FakeSweep sweep{{"lookup.filter=nearest,linear,pcf3,hardware",
                         "lookup.outside=lit,shadowed,clamp", "bias.normal_texels=0,1",
                         "bias.slope=0,0.0625", "bias.constant=0.0625,-0.125,0,0.3"},
                        {{"shadow_map.reversed", reversed}, {"shadow_map.resolution", "5"}}};
        EXPECT_EQ(sweep.run(), sweep.planned);
        EXPECT_THAT(sweep.failed, IsEmpty());
        expect_compared(sweep);
    }
}

TEST(SweepRunner, GivesTheSameRowsWhenItKeepsPixels)
{
    const std::vector<std::string> axes{"lookup.filter=nearest,pcf3,hardware",
                                        "bias.normal_texels=0,1", "bias.slope=0,0.0625",
                                        "bias.constant=0,0.125"};
    FakeSweep curves{axes, {{"shadow_map.resolution", "5"}}, two_cameras};
    FakeSweep pixels{axes, {{"shadow_map.resolution", "5"}}, two_cameras};
    pixels.keep_pixels();
    curves.run();
    EXPECT_EQ(pixels.run(), pixels.planned);
    EXPECT_EQ(curves.done, pixels.done);
    EXPECT_THAT(curves.kept, IsEmpty());
    std::sort(pixels.kept.begin(), pixels.kept.end());
    ASSERT_EQ(pixels.kept.size(), pixels.space.size());
    for (std::size_t i = 0; i < pixels.kept.size(); ++i) {
        EXPECT_EQ(pixels.kept[i], i);
    }
    ASSERT_EQ(curves.curves.size(), pixels.curves.size());
    for (const auto& [id, curve] : curves.curves) {
        const CurveResult& other = pixels.curves.at(id);
        EXPECT_EQ(curve.near_m, other.near_m);
        EXPECT_EQ(curve.far_m, other.far_m);
        EXPECT_EQ(curve.map_bytes, other.map_bytes);
        ASSERT_EQ(curve.best.has_value(), other.best.has_value());
        ASSERT_EQ(curve.points.size(), other.points.size());
        ASSERT_EQ(curve.by_distance.size(), other.by_distance.size());
        for (std::size_t i = 0; i < curve.by_distance.size(); ++i) {
            EXPECT_EQ(curve.by_distance[i].at, other.by_distance[i].at);
            EXPECT_EQ(curve.by_distance[i].bias, other.by_distance[i].bias);
            EXPECT_EQ(text_of(curve.by_distance[i].bins), text_of(other.by_distance[i].bins));
        }
    }
}

TEST(SweepRunner, DescribesTheCurveAtTheJobsOwnBias)
{
    FakeSweep sweep{{"bias.slope=0,0.0625"}, {{"bias.constant", "0.125"}}};
    sweep.run();
    FakeSweep biases{{"bias.slope=0,0.0625", "bias.constant=0,0.5"}};
    biases.run();
    for (std::uint64_t i = 0; i < 2; ++i) {
        const Comparison own = sweep.compared(i);
        const BiasAnswers& answers = *own.diagnosis->biases;
        const SweepCatalogue catalogue{sweep.space, false, "1.0"};
        const CurveResult& curve = sweep.curves.at(catalogue.task(i, "hash").id);
        ASSERT_EQ(curve.by_distance.size(), 2U);
        EXPECT_EQ(curve.by_distance[0].at, DistanceProfile::At::job_bias);
        EXPECT_EQ(curve.by_distance[0].bias, 0.125F);
        EXPECT_EQ(text_of(curve.by_distance[0].bins), text_of(own.diagnosis->by_distance));
        EXPECT_EQ(curve.by_distance[1].bias, answers.best.recommended());
        EXPECT_EQ(curve.best->interval.lo, answers.best.interval.lo);
        EXPECT_EQ(curve.best->interval.hi, answers.best.interval.hi);
        EXPECT_EQ(curve.best->errors.total(), answers.best.errors.total());
        EXPECT_EQ(curve.bounds->strict.acne_free, answers.bounds.strict.acne_free);
        EXPECT_EQ(curve.bounds->strict.panning_free, answers.bounds.strict.panning_free);
        EXPECT_EQ(curve.near_m, own.view.frustum.near_m);
        // Without a bias of its own the job has none, whatever its axis asks for.
        EXPECT_EQ(biases.curves.at(curve.id).by_distance[0].bias, 0.0F);
    }
}

TEST(SweepRunner, HasNoCurveForHardware)
{
    FakeSweep sweep{{"bias.constant=0,0.125"}, {{"lookup.filter", "hardware"}}};
    sweep.run();
    ASSERT_EQ(sweep.curves.size(), 2U);
    for (const auto& [id, curve] : sweep.curves) {
        EXPECT_FALSE(curve.best.has_value());
        EXPECT_FALSE(curve.bounds.has_value());
        EXPECT_THAT(curve.points, IsEmpty());
        EXPECT_EQ(curve.by_distance.size(), 1U);
    }
}

TEST(SweepRunner, KeepsMoreCamerasThanSlotsApart)
{
    std::vector<scene::CaseLayer> cameras;
    for (int i = 0; i < 5; ++i) {
        cameras.push_back(
            case_of(fmt::format("{}", i), {{"camera.eye", fmt::format("[{}, 5, 0]", i)}}));
    }
    for (const std::size_t slots : {1U, 2U, 3U, 8U}) {
        FakeSweep sweep{{"shadow_map.near=-2,-1", "shadow_map.resolution=4,8"}, {}, cameras};
        sweep.slots = slots;
        EXPECT_EQ(sweep.run(), sweep.planned);
        EXPECT_THAT(sweep.failed, IsEmpty());
        expect_compared(sweep);
    }
}

TEST(SweepRunner, OfNoStepDoesNothing)
{
    SweepHooks hooks;
    hooks.should_stop = [] { return false; };
    EXPECT_EQ(run_sweep({}, hooks), PlanCounts{});
}

/// Ordinals whose job has this value of the key.
std::set<std::uint64_t> ordinals_with(const FakeSweep& sweep, const std::string& key,
                                      const std::string& value)
{
    std::set<std::uint64_t> found;
    for (std::uint64_t i = 0; i < sweep.space.size(); ++i) {
        for (const auto& [name, text] : scene::resolved_keys(sweep.space.job(sweep.space.at(i)))) {
            if (name == key && text == value) {
                found.insert(i);
            }
        }
    }
    return found;
}

/// Exactly these failed, with these words; all others are as ever.
void expect_failed(const FakeSweep& sweep, const std::set<std::uint64_t>& ordinals,
                   const std::string& words)
{
    std::set<std::uint64_t> failed;
    for (const auto& [ordinal, message] : sweep.failed) {
        failed.insert(ordinal);
        EXPECT_EQ(message, words) << ordinal;
    }
    EXPECT_EQ(failed, ordinals);
    expect_compared(sweep);
}

/// A stage that fails, and which configurations need what it makes.
struct BadStage {
    std::string stage;
    std::function<bool(const scene::Job*, const scene::View&)> fails;
    std::string key;
    std::string value;
};

TEST(SweepRunner, FailsOnlyWhatNeedsAStageThatFailed)
{
    const auto is_left = [](const scene::Job*, const scene::View& view) {
        return view.camera.eye.x == 1;
    };
    const auto is_small = [](const scene::Job* job, const scene::View&) {
        return job->shadow_map.resolution_texels == 4;
    };
    const auto is_clamped = [](const scene::Job* job, const scene::View&) {
        return job->lookup.outside == scene::Outside::clamp;
    };
    const std::vector<BadStage> stages{{"receivers", is_left, "camera.eye", "[1, 5, 0]"},
                                       {"truth", is_left, "camera.eye", "[1, 5, 0]"},
                                       {"map", is_small, "shadow_map.resolution", "4"},
                                       {"lookup", is_clamped, "lookup.outside", "\"clamp\""},
                                       {"light", is_clamped, "lookup.outside", "\"clamp\""}};
    for (const BadStage& bad : stages) {
        for (const bool keeps_pixels : {false, true}) {
            SCOPED_TRACE(fmt::format("{}, keeps pixels: {}", bad.stage, keeps_pixels));
            FakeSweep sweep{{"shadow_map.resolution=4,8", "lookup.outside=lit,clamp",
                             "bias.slope=0,0.25", "bias.constant=0,0.25"},
                            {},
                            two_cameras};
            if (keeps_pixels) {
                sweep.keep_pixels();
            }
            sweep.world.before_stage = [&](std::string_view stage, const scene::Job* job,
                                           const scene::View& view) {
                if (stage == bad.stage && bad.fails(job, view)) {
                    throw scene::EnvironmentError{"the driver ran away"};
                }
            };
            sweep.run();
            sweep.world.before_stage = {};
            expect_failed(sweep, ordinals_with(sweep, bad.key, bad.value), "the driver ran away");
        }
    }
}

TEST(SweepRunner, FailsOnlyTheSceneThatCannotBeRead)
{
    for (const bool keeps_pixels : {false, true}) {
        FakeSweep sweep{{"bias.slope=0,0.25", "bias.constant=0,0.25"},
                        {},
                        {case_of("a", {{"scene.builtin", "wall"}}),
                         case_of("b", {{"scene.builtin", "room"}}),
                         case_of("c", {{"scene.builtin", "yard"}})}};
        if (keeps_pixels) {
            sweep.keep_pixels();
        }
        sweep.hooks.open_scene = [&](const scene::Job& job) {
            if (job.scene.builtin == "room") {
                throw scene::InputError{"the room is locked"};
            }
            return OpenScene{&sweep.world.file(), &sweep.world.renderers()};
        };
        sweep.run();
        expect_failed(sweep, ordinals_with(sweep, "scene.builtin", "\"room\""),
                      "the room is locked");
    }
}

TEST(SweepRunner, FailsOnlyConfigurationsWithoutAFrustum)
{
    // Whether near is before the far plane that the scene decides, only the scene says.
    FakeSweep sweep{{"shadow_map.near=-2,100000", "bias.constant=0,0.25"}};
    sweep.run();
    ASSERT_EQ(sweep.failed.size(), 2U);
    EXPECT_THAT(sweep.failed.at(2), HasSubstr("near"));
    EXPECT_EQ(sweep.failed.at(2), sweep.failed.at(3));
    EXPECT_EQ(sweep.done.at(0), result_text(sweep.compared(0)));
}

TEST(SweepRunner, FailsOnlyTheRowWhoseBiasIsNone)
{
    // A metre's smallest part is subnormal as a depth.
    for (const bool keeps_pixels : {false, true}) {
        FakeSweep sweep{{"bias.slope=0,0.25", "bias.constant_m=0.25,1.2e-38,0.5"}};
        if (keeps_pixels) {
            sweep.keep_pixels();
        }
        sweep.run();
        ASSERT_EQ(sweep.failed.size(), 2U);
        EXPECT_THAT(sweep.failed.at(1), HasSubstr("bias.constant_m"));
        EXPECT_THAT(sweep.failed.at(4), HasSubstr("bias.constant_m"));
        expect_compared(sweep);
    }
}

TEST(SweepRunner, FailsARowBesideAFailingCurveOnce)
{
    FakeSweep sweep{{"bias.constant_m=0.25,1.2e-38,0.5"}};
    sweep.world.before_stage = [](std::string_view stage, const scene::Job*, const scene::View&) {
        if (stage == "light") {
            throw scene::EnvironmentError{"no light"};
        }
    };
    sweep.run();
    ASSERT_EQ(sweep.failed.size(), 3U);
    EXPECT_EQ(sweep.failed.at(0), "no light");
}

TEST(SweepRunner, FailsACurveOfWhichNoRowHasABias)
{
    FakeSweep sweep{{"bias.constant_m=1.2e-38,1.3e-38"}};
    sweep.run(); // `record` would object to a curve without rows
    EXPECT_EQ(sweep.failed.size(), 2U);
    EXPECT_THAT(sweep.curves, IsEmpty());
}

TEST(SweepRunner, LetsABadBiasFailNoStageThatOthersShare)
{
    for (const bool keeps_pixels : {false, true}) {
        FakeSweep sweep{
            {},
            {},
            {case_of("bad", {{"bias.constant_m", "1.2e-38"}, {"camera.eye", "[0, 5, 0]"}}),
             case_of("good", {{"bias.slope", "0.25"}, {"camera.eye", "[0, 5, 0]"}})}};
        if (keeps_pixels) {
            sweep.keep_pixels();
        }
        sweep.run();
        EXPECT_EQ(sweep.failed.size(), 1U);
        EXPECT_EQ(sweep.done.count(1), 1U);
        expect_compared(sweep);
    }
}

TEST(SweepRunner, AsksForNothingOfAJobsBiasThatItsAxisReplaces)
{
    FakeSweep sweep{{"bias.constant=0,0.25"}, {{"bias.constant_m", "1.2e-38"}}};
    sweep.run();
    EXPECT_THAT(sweep.failed, IsEmpty());
    expect_compared(sweep);
}

TEST(SweepRunner, StopsAfterWhatHasBegun)
{
    FakeSweep whole{{"shadow_map.resolution=4,8", "bias.slope=0,0.25", "bias.constant=0,0.25"}};
    whole.run();
    for (int steps = 0; steps < 12; ++steps) {
        FakeSweep sweep{{"shadow_map.resolution=4,8", "bias.slope=0,0.25", "bias.constant=0,0.25"}};
        int asked = 0;
        sweep.hooks.should_stop = [&] { return asked++ == steps; };
        const PlanCounts counts = sweep.run();
        EXPECT_EQ(counts.configurations, sweep.done.size()) << steps << " steps";
        EXPECT_THAT(sweep.failed, IsEmpty());
        for (const auto& [ordinal, text] : sweep.done) {
            EXPECT_EQ(text, whole.done.at(ordinal)) << steps << " steps";
        }
        // Scene, receivers, truth, map and lookup come before the first answer.
        EXPECT_EQ(counts.curves, steps < 6    ? 0U
                                 : steps < 7  ? 1U
                                 : steps < 10 ? 2U
                                 : steps < 11 ? 3U
                                              : 4U)
            << steps << " steps";
    }
}

TEST(SweepRunner, EndsWithWhatRecordThrows)
{
    for (const bool keeps_pixels : {false, true}) {
        FakeSweep sweep{{"shadow_map.resolution=4,5,6,7,8", "bias.constant=0,0.25"}};
        if (keeps_pixels) {
            sweep.keep_pixels();
        }
        int recorded = 0;
        sweep.hooks.record = [&](const FinishedCurve&) {
            if (++recorded == 2) {
                throw scene::EnvironmentError{"the disk is full"};
            }
        };
        try {
            sweep.run();
            ADD_FAILURE() << "nothing was thrown";
        } catch (const scene::EnvironmentError& error) {
            EXPECT_STREQ(error.what(), "the disk is full");
        }
        EXPECT_EQ(recorded, 2) << "it went on";
        EXPECT_THAT(sweep.failed, IsEmpty());
    }
}

TEST(SweepRunner, EndsWithWhatKeepPixelsThrows)
{
    FakeSweep sweep{{"shadow_map.resolution=4,5,6"}};
    sweep.hooks.keep_pixels = [](std::uint64_t, const Comparison&) {
        throw scene::EnvironmentError{"the disk is full"};
    };
    EXPECT_THROW(sweep.run(), scene::EnvironmentError);
    EXPECT_THAT(sweep.done, IsEmpty());
    EXPECT_THAT(sweep.failed, IsEmpty());
}

TEST(SweepRunner, EndsWithWhatIsNobodysFault)
{
    FakeSweep sweep{{"shadow_map.resolution=4,5,6"}};
    sweep.world.before_stage = [](std::string_view stage, const scene::Job*, const scene::View&) {
        if (stage == "light") {
            throw std::logic_error{"a defect"};
        }
    };
    EXPECT_THROW(sweep.run(), std::logic_error);
}

} // namespace
} // namespace gnomon::analysis
