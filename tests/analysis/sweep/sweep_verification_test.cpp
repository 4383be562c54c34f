// Verifies curves of a sweep with GL's reruns.

#include "analysis/sweep/compare.hpp"
#include "fake_sweep.hpp"
#include "lane.hpp"
#include "renderers/forwarding.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {
namespace {

using ::testing::IsEmpty;

const std::vector<std::string> axes{"lookup.filter=nearest,pcf3", "bias.normal_texels=0,1",
                                    "bias.slope=0,0.0625", "bias.constant=0,0.125,0.3"};
const std::vector<scene::Override> small_map{{"shadow_map.resolution", "5"}};

TEST(SweepVerification, FindsNoDifferenceWhereGlDoesWhatTheCurveSays)
{
    const std::vector<std::string> fewer{"lookup.filter=nearest,pcf3", "bias.normal_texels=1",
                                         "bias.slope=0.0625", "bias.constant=0,0.125,0.3"};
    FakeSweep sweep{tests::in_lane(fewer, axes), small_map, two_cameras()};
    sweep.hooks.verifies_biases = true;
    EXPECT_EQ(sweep.run(), sweep.planned);
    EXPECT_THAT(sweep.failed, IsEmpty());
    expect_compared(sweep);
    EXPECT_EQ(sweep.curves.size(), tests::in_lane(4U, 16U));
    for (const auto& [id, curve] : sweep.curves) {
        ASSERT_TRUE(curve.verification) << id;
        EXPECT_EQ(curve.verification->differences(), 0U) << id;
        EXPECT_GE(curve.verification->reruns.size(), 10U) << id;
        for (const float bias : {0.0F, 0.125F, 0.3F, curve.best->recommended()}) {
            EXPECT_TRUE(std::any_of(
                curve.verification->reruns.begin(), curve.verification->reruns.end(),
                [&](const BiasVerification::Rerun& rerun) { return rerun.bias == bias; }))
                << id << " " << bias;
        }
    }
}

TEST(SweepVerification, ChangesNoResult)
{
    FakeSweep plain{axes, small_map, two_cameras()};
    FakeSweep verified{axes, small_map, two_cameras()};
    verified.hooks.verifies_biases = true;
    plain.run();
    verified.run();
    EXPECT_EQ(plain.done, verified.done);
    for (const auto& [id, curve] : plain.curves) {
        EXPECT_FALSE(curve.verification) << "not asked for";
        EXPECT_EQ(curve.points, verified.curves.at(id).points);
    }
}

/// The world's renderers, with a driver that ignores every bias above the limit.
class ForgetfulRenderers {
public:
    ForgetfulRenderers(const SweepWorld& world, float limit)
        : rasterizer_{world.renderers().rasterizer, limit},
          renderers_{rasterizer_, world.renderers().reference, {}}
    {
    }
    [[nodiscard]] const Renderers& renderers() const { return renderers_; }

private:
    class Rasterizer final : public renderers::ForwardingRasterizer {
    public:
        Rasterizer(renderers::Rasterizer& own, float limit)
            : ForwardingRasterizer{own},
              limit_{limit}
        {
        }
        scene::LookupLayers look_up(const renderers::LookupRequest& request) override
        {
            scene::View view = request.view;
            view.bias.constant = view.bias.constant > limit_ ? 0 : view.bias.constant;
            return ForwardingRasterizer::look_up({request.drawn, request.job, view});
        }

    private:
        float limit_;
    };

    Rasterizer rasterizer_;
    Renderers renderers_;
};

TEST(SweepVerification, CountsWhatGlDoesOtherwise)
{
    for (const bool keeps_pixels : {false, true}) {
        FakeSweep sweep{{"bias.slope=0,0.0625", "bias.constant=0,0.125"}, small_map};
        sweep.hooks.verifies_biases = true;
        if (keeps_pixels) {
            sweep.keep_pixels();
        }
        // The driver ignores large biases.
        const ForgetfulRenderers forgetful{sweep.world, 0.5F};
        const Renderers& renderers = forgetful.renderers();
        sweep.hooks.open_scene = [&](const scene::Job&) {
            return OpenScene{&sweep.world.file(), &renderers};
        };
        std::uint64_t differences = 0;
        std::size_t verified = 0;
        const auto record = sweep.hooks.record;
        sweep.hooks.record = [&](FinishedCurve&& finished) {
            const auto& verification = finished.curve.verification;
            verified += verification ? 1U : 0U;
            differences += verification ? verification->differences() : 0;
            record(std::move(finished));
        };
        sweep.run();
        EXPECT_EQ(sweep.done.size(), 4U) << "results are recorded all the same";
        EXPECT_EQ(verified, 2U) << "each curve once";
        EXPECT_GT(differences, 0U) << "keeps pixels: " << keeps_pixels;
    }
}

TEST(SweepVerification, IsMadeUnaskedWhereALookupIsNotTheCurves)
{
    FakeSweep sweep{{"bias.constant=0,0.125"}, small_map};
    sweep.keep_pixels();
    const ForgetfulRenderers forgetful{sweep.world, 0.1F};
    const Renderers& renderers = forgetful.renderers();
    sweep.hooks.open_scene = [&](const scene::Job&) {
        return OpenScene{&sweep.world.file(), &renderers};
    };
    std::vector<float> contradicted;
    sweep.hooks.record = [&](FinishedCurve&& finished) {
        if (const auto& verification = finished.curve.verification) {
            EXPECT_GT(verification->differences(), 0U);
            contradicted.push_back(verification->reruns.front().bias);
        }
    };
    sweep.run();
    EXPECT_EQ(contradicted, std::vector<float>{0.125F});
}

TEST(SweepVerification, IsMadeUnaskedOfEachLookupOfACurveByBisection)
{
    FakeSweep sweep{{"lookup.filter=hardware", "bias.constant=0,0.125"}, small_map};
    const ForgetfulRenderers forgetful{sweep.world, 0.1F};
    const Renderers& renderers = forgetful.renderers();
    sweep.hooks.open_scene = [&](const scene::Job&) {
        return OpenScene{&sweep.world.file(), &renderers};
    };
    sweep.run();
    ASSERT_EQ(sweep.curves.size(), 1U);
    const auto& verification = sweep.curves.begin()->second.verification;
    ASSERT_TRUE(verification);
    EXPECT_GT(verification->differences(), 0U);
    EXPECT_TRUE(std::ranges::all_of(verification->reruns,
                                    [](const auto& rerun) { return rerun.bias > 0.1F; }));
}

TEST(Compare, HoldsItsLookupToTheCurve)
{
    const FakeSweep sweep{{"lookup.filter=nearest,pcf3,hardware", "bias.constant=0,0.125"},
                          small_map};
    for (std::uint64_t ordinal = 0; ordinal < sweep.space.size(); ++ordinal) {
        const scene::Job job = sweep.space.job(sweep.space.at(ordinal));
        const Comparison held = compare(job, sweep.world.file(), sweep.world.renderers());
        const Comparison other =
            compare(job, sweep.world.file(), ForgetfulRenderers{sweep.world, 0.1F}.renderers());
        EXPECT_EQ(held.held->differences, 0U) << "ordinal " << ordinal;
        EXPECT_EQ(other.held->differences > 0, job.bias.constant > 0) << "ordinal " << ordinal;
    }
}

TEST(Compare, LetsGoOfEachMap)
{
    FakeSweep sweep{{"lookup.filter=nearest,pcf3,hardware", "bias.normal_texels=0,1"}, small_map};
    for (std::uint64_t ordinal = 0; ordinal < sweep.space.size(); ++ordinal) {
        sweep.world.calls.clear();
        const scene::Job job = sweep.space.job(sweep.space.at(ordinal));
        (void)compare(job, sweep.world.file(), sweep.world.renderers());
        const auto drawn = std::ranges::count(sweep.world.calls, "map");
        EXPECT_GE(drawn, 1) << "ordinal " << ordinal;
        EXPECT_GE(std::ranges::count(sweep.world.calls, "map ends"), drawn)
            << "ordinal " << ordinal;
    }
}

TEST(SweepVerification, HoldsACurveByBisectionToo)
{
    FakeSweep sweep{{"lookup.filter=hardware", "bias.constant=0,0.125"}, small_map};
    sweep.hooks.verifies_biases = true;
    EXPECT_EQ(sweep.run(), sweep.planned);
    EXPECT_EQ(sweep.done.size(), 2U);
    ASSERT_EQ(sweep.curves.size(), 1U);
    const auto& verification = sweep.curves.begin()->second.verification;
    ASSERT_TRUE(verification);
    EXPECT_GE(verification->reruns.size(), 10U);
    EXPECT_EQ(verification->differences(), 0U);
}

} // namespace
} // namespace gnomon::analysis
