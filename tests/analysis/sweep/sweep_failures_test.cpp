// Failing stages, rows and hooks of a sweep, and what still goes on.

#include "analysis/sweep/runner.hpp"

#include "fake_sweep.hpp"
#include "lane.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

/// Expects exactly these ordinals to fail, with these words, and all others to be right.
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

/// A stage that fails, and the configurations that need its result.
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
    std::size_t number = 0;
    for (const BadStage& bad : stages) {
        ++number;
        for (const bool keeps_pixels : {false, true}) {
            if (!tests::runs_full_tests() && keeps_pixels == (number % 2 == 0)) {
                continue; // the usual lane fails each stage once
            }
            SCOPED_TRACE(fmt::format("{}, keeps pixels: {}", bad.stage, keeps_pixels));
            FakeSweep sweep{{"shadow_map.resolution=4,8", "lookup.outside=lit,clamp",
                             tests::in_lane("bias.slope=0.25", "bias.slope=0,0.25"),
                             "bias.constant=0,0.25"},
                            {},
                            two_cameras()};
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
        FakeSweep sweep{
            {tests::in_lane("bias.slope=0.25", "bias.slope=0,0.25"), "bias.constant=0,0.25"},
            {},
            {case_of("a", {{"scene.builtin", "wall"}}), case_of("b", {{"scene.builtin", "room"}}),
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
        EXPECT_THAT(sweep.need_other_keys, IsEmpty()) << "the file may be mended";
    }
}

TEST(SweepRunner, FailsOnlyConfigurationsWithoutAFrustum)
{
    // Only the scene tells whether near is before the far plane, which it decides.
    FakeSweep sweep{{"shadow_map.near=-2,100000", "bias.constant=0,0.25"}};
    sweep.run();
    ASSERT_EQ(sweep.failed.size(), 2U);
    EXPECT_THAT(sweep.failed.at(2), HasSubstr("near"));
    EXPECT_EQ(sweep.failed.at(2), sweep.failed.at(3));
    EXPECT_EQ(sweep.done.at(0), result_text(sweep.compared(0)));
    EXPECT_THAT(sweep.may_be_retried, IsEmpty()) << "no other run has another frustum";
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
