// Compares causes found by rerunning a method over exact depths with the exact causes.
// Bisection.FindsWhatTheFormulaSays (tests/acceptance/bias_identity_test.cpp) checks that the
// critical biases of pcf3 by bisection equal those by formula.

#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/texel_hits.hpp"
#include "analysis/sweep/compare.hpp"
#include "compared.hpp"
#include "lane.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "renderers/forwarding.hpp"
#include "renderers/light_queries.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tests {
namespace {

using scene::PixelClass;

const std::vector<scene::Override> small{
    {"image.width", "144"}, {"image.height", "81"}, {"shadow_map.resolution", "256"}};

/// The depths of the rerun.
struct RerunDepths {
    scene::Image<float> map;
    scene::Image<float> receivers;
};

struct Rerun {
    analysis::Comparison result;
    RerunDepths depths;
};

/// Records the exact depths that it stores.
class NotingRasterizer final : public renderers::ForwardingRasterizer {
public:
    NotingRasterizer(renderers::Rasterizer& own, RerunDepths& noted)
        : ForwardingRasterizer{own},
          noted_{noted}
    {
    }
    std::shared_ptr<const renderers::FilteredMap>
    store_map(const scene::Job& job, const scene::View& view,
              const renderers::ExactDepths& depths) override
    {
        noted_ = {depths.map, depths.receivers};
        return ForwardingRasterizer::store_map(job, view, depths);
    }

private:
    RerunDepths& noted_;
};

Rerun compare_by_rerun(const Compared& scene, scene::Job job)
{
    job.method.name = "depth_by_rerun";
    const analysis::Renderers& own = scene.renderers();
    Rerun rerun;
    NotingRasterizer noting{own.rasterizer, rerun.depths};
    rerun.result = analysis::compare(job, scene.file(), {noting, own.reference, own.environment});
    return rerun;
}

/// Explains why the causes of a pixel may differ.
class Explained {
public:
    Explained(const Compared& scene, const analysis::Comparison& exact, const RerunDepths& depths)
        : exact_{exact},
          depths_{depths},
          footprint_{methods::traits(exact.job),
                     analysis::lookup_rule(exact.job, exact.view).edge(),
                     exact.job.shadow_map.resolution_texels},
          light_{scene.renderers().reference.make_light_queries(exact.job, exact.view,
                                                                exact.receivers)}
    {
    }

    /// Whether float32 decides one of its taps.
    ///
    /// In float32 the tap is lit iff fl(fl(r) − b) <= fl(d), exactly iff r − b <= d. r and d round
    /// by at most half an ulp of what is below 1, 2^-25; so does their difference. Hence where the
    /// answers differ, |fl(r) − b − fl(d)| <= 3 · 2^-25.
    [[nodiscard]] bool is_decided_by_rounding(std::size_t pixel) const
    {
        const bool is_lit = exact_.truth.pixel_class[pixel] == PixelClass::lit;
        const double bias = is_lit ? double{exact_.view.bias.constant} : 0;
        const double sign = exact_.view.first_map().reversed ? -1 : 1;
        for (const analysis::Tap& tap : taps(pixel)) {
            const double r{depths_.receivers[pixel]};
            const double d{depth(tap.texel)};
            if (std::abs(sign * (r - d) - bias) <= 3 * 0x1p-25) {
                return true;
            }
        }
        return false;
    }
    /// Whether it is blocked and one of several taps sees the receiver's own surface. Such a tap
    /// counts as lit if verdicts come from taps; otherwise the receiver's texel decides.
    [[nodiscard]] bool sees_own_sheet(std::size_t pixel) const
    {
        if (exact_.truth.pixel_class[pixel] != PixelClass::blocked || footprint_.tap_count() == 1) {
            return false;
        }
        std::vector<scene::Texel> texels;
        for (const analysis::Tap& tap : taps(pixel)) {
            texels.push_back(tap.texel);
        }
        const auto hits = light_->first_hits(texels, renderers::HitDetail::bounded);
        std::vector<renderers::SelfShadowingQuery> queries;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (hits[i].triangle != scene::no_triangle) {
                queries.push_back({pixel, texels[i], hits[i].triangle});
            }
        }
        const auto own = light_->are_self_shadowing(queries);
        return std::ranges::any_of(own, [](std::uint8_t is_own) { return is_own != 0; });
    }
    [[nodiscard]] std::string text(std::size_t pixel) const
    {
        std::string line = fmt::format("r {:.9g}, d", depths_.receivers[pixel]);
        for (const analysis::Tap& tap : taps(pixel)) {
            line += fmt::format(" {:.9g}", depth(tap.texel));
        }
        return line;
    }

private:
    [[nodiscard]] std::vector<analysis::Tap> taps(std::size_t pixel) const
    {
        auto all = footprint_.taps(exact_.lookup.at(pixel));
        std::erase_if(all, [](const analysis::Tap& tap) { return !tap.is_inside; });
        return all;
    }
    [[nodiscard]] float depth(const scene::Texel& texel) const
    {
        return at_texel(depths_.map, texel);
    }

    const analysis::Comparison& exact_;
    const RerunDepths& depths_;
    analysis::Footprint footprint_;
    std::unique_ptr<renderers::LightQueries> light_;
};

struct Differences {
    std::size_t compared = 0; ///< scored pixels that have a cause
    std::size_t by_rounding = 0;
    std::size_t by_own_sheet = 0;
};

Differences expect_same_causes(const Compared& scene, const scene::Job& job)
{
    const auto exact = scene(job);
    const Rerun rerun = compare_by_rerun(scene, job);
    const Explained explained{scene, exact, rerun.depths};
    EXPECT_EQ(exact.metrics.false_shadow, rerun.result.metrics.false_shadow);
    EXPECT_EQ(exact.metrics.false_lit, rerun.result.metrics.false_lit);
    const auto& a = exact.diagnosis->causes;
    const auto& b = rerun.result.diagnosis->causes;
    Differences found;
    for (std::size_t i = 0; i < a.cause.pixel_count(); ++i) {
        found.compared += a.cause[i] != analysis::Cause::none ? 1U : 0U;
        if (a.cause[i] == b.cause[i] && a.label[i] == b.label[i]) {
            continue;
        }
        if (explained.is_decided_by_rounding(i)) {
            ++found.by_rounding;
        } else if (explained.sees_own_sheet(i)) {
            ++found.by_own_sheet;
        } else {
            ADD_FAILURE() << "pixel " << i << ", "
                          << (exact.truth.pixel_class[i] == PixelClass::lit ? "lit" : "blocked")
                          << ", verdict " << exact.lookup.samples[i].verdict << ": exactly "
                          << analysis::cause_names.at(static_cast<std::size_t>(a.cause[i])) << ", "
                          << analysis::label_names.at(static_cast<std::size_t>(a.label[i]))
                          << "; by rerun "
                          << analysis::cause_names.at(static_cast<std::size_t>(b.cause[i])) << ", "
                          << analysis::label_names.at(static_cast<std::size_t>(b.label[i])) << "; "
                          << explained.text(i);
            break;
        }
    }
    return found;
}

class CausesByRerun : public testing::TestWithParam<const char*> {};

TEST_P(CausesByRerun, AreTheExactOnesButWhereFloat32Decides)
{
    GNOMON_REQUIRE_GL();
    const std::string filter = GetParam();
    Differences all;
    std::size_t scenes = 0;
    for (const auto& [builtin, content] : {std::pair{"sphere-plane", "depth"},
                                           {"sphere-cube", "depth"},
                                           {"wall", "depth"},
                                           {"terrain", "depth"},
                                           {"lamp-room", "depth"},
                                           {"lamp-room", "distance"},
                                           {"sphere-plane", "distance"}}) {
        const auto keys = with(small, {{"lookup.filter", filter}, {"shadow_map.content", content}});
        const Compared scene{job_of_builtin(builtin, keys)};
        std::size_t number = scenes++;
        for (const auto& [format, bias] : {std::pair{"d24", "0"},
                                           {"d24", "0.0005"},
                                           {"d24", "0.02"},
                                           {"u8", "0.0005"},
                                           {"r16f", "0.0005"},
                                           {"rgba8", "0.0005"}}) {
            if (!runs_full_tests() && number++ % 4 != 0) {
                continue; // the usual lane tries each scene, and each format and bias
            }
            SCOPED_TRACE(
                fmt::format("{} {} {} {} bias {}", builtin, content, filter, format, bias));
            const Differences found = expect_same_causes(
                scene, job_of_builtin(builtin, with(keys, {{"shadow_map.depth_format", format},
                                                           {"bias.slope", "0"},
                                                           {"bias.normal_texels", "0"},
                                                           {"bias.constant", bias}})));
            all.compared += found.compared;
            all.by_rounding += found.by_rounding;
            all.by_own_sheet += found.by_own_sheet;
        }
    }
    std::printf(
        "%s: of %zu pixels with a cause %zu are decided by float32, %zu see their own sheet\n",
        filter.c_str(), all.compared, all.by_rounding, all.by_own_sheet);
    EXPECT_GT(all.compared, in_lane(1'000U, 4'000U));
    // Where a surface shadows itself, r and d differ by up to a texel's slope, 1e-4 and more of the
    // depth range. Fewer than one tap in 500 is within 3 · 2^-25 of another; with nine taps, one
    // pixel in 50. Nearly all taps are farther: none but counted pixels, and few of them.
    EXPECT_LT(all.by_rounding, all.compared / 50);
    if (filter == "nearest") {
        EXPECT_EQ(all.by_own_sheet, 0U);
    }
}

/// A verdict at the job's bias is at least this high iff the bias is at least the critical one.
TEST_P(CausesByRerun, NeedNoVerdictsThatRiseWithTheBias)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin : {"sphere-plane", "wall"}) {
        const auto keys = with(small, {{"lookup.filter", GetParam()}});
        const Compared scene{job_of_builtin(builtin, keys)};
        for (const auto& [bias, slope] : {std::pair{"0.0005", "0"}, {"0.0002", "0.0003"}}) {
            SCOPED_TRACE(fmt::format("{} bias {} slope {}", builtin, bias, slope));
            scene::Job job = job_of_builtin(
                builtin, with(keys, {{"bias.constant", bias}, {"bias.slope", slope}}));
            job.method.name = "depth_by_rerun";
            const auto rising = scene(job);
            job.method.name = "depth_by_look_up";
            const auto other = scene(job);
            EXPECT_FALSE(other.diagnosis->biases);
            EXPECT_GT(other.metrics.false_shadow + other.metrics.false_lit, 40U);
            const auto& expected = rising.diagnosis->causes;
            const auto& found = other.diagnosis->causes;
            EXPECT_EQ(found.counts.by_cause, expected.counts.by_cause);
            EXPECT_EQ(found.counts.by_label, expected.counts.by_label);
            for (std::size_t i = 0; i < expected.cause.pixel_count(); ++i) {
                ASSERT_EQ(found.cause[i], expected.cause[i]) << "pixel " << i;
                ASSERT_EQ(found.label[i], expected.label[i]) << "pixel " << i;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Filters, CausesByRerun, testing::Values("nearest", "pcf3"));

} // namespace
} // namespace gnomon::tests
