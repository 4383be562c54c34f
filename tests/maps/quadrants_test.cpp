// The four quarters of a map give the depths and verdicts of the whole map.

#include "analysis/comparison/comparison.hpp"
#include "compared.hpp"
#include "lane.hpp"
#include "methods/job_method.hpp"
#include "methods_job.hpp"
#include "quadrants.hpp"
#include "raster_gl/map/shadow_map.hpp"
#include "reference_rt/light/light_queries.hpp"
#include "scene/job/file.hpp"
#include "scene/pixels/map_texels.hpp"
#include "straight_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

using analysis::Comparison;
using scene::Filter;
using scene::Texel;

scene::Job of_quarters(scene::Job job)
{
    job.shadow_map.resolution_texels /= 2;
    return job;
}

/// Both layouts of a job's scene, compared.
struct BothLayouts {
    Comparison whole;
    Comparison quarters;
};

/// Compares with the map in quarters, a layout that no job can ask for.
Comparison compare_quarters(const Compared& scene, const scene::Job& job)
{
    const analysis::Renderers& renderers = scene.renderers();
    Comparison quarters = begin_comparison(job, scene.file(), {}, renderers);
    quarters.view = in_quadrants(quarters.view);
    return compare_straight(std::move(quarters), renderers);
}

BothLayouts compare_both(const Compared& scene, const scene::Job& job)
{
    return {scene(job), compare_quarters(scene, of_quarters(job))};
}

/// Coordinates on the two maps differ by a few float32 roundings of numbers up to 1, times the
/// texels.
constexpr float coordinate_error = 0x1p-22F * 256;

/// Whether a lookup reads one quarter alone, and reads certain texels.
bool is_away_from_borders(const Comparison& whole, std::size_t pixel)
{
    const auto half = static_cast<float>(whole.job.shadow_map.resolution_texels) / 2;
    const scene::Vec2f at = whole.lookup.texels[pixel];
    const float reach = static_cast<float>(methods::traits(whole.job).width_texels) / 2 + 1 +
                        whole.view.bias.normal_texels;
    const auto is_away = [&](float x) {
        const float from_edge = std::min({x, std::abs(x - half), 2 * half - x});
        const float from_border = std::abs(2 * x - std::round(2 * x)) / 2; // of a texel or its half
        return from_edge > reach && from_border > coordinate_error;
    };
    return is_away(at.x) && is_away(at.y);
}

/// The most that a verdict or a looked-up depth may differ.
float tolerance_of(const scene::Job& job)
{
    if (!methods::traits(job).interpolates()) {
        return 0;
    }
    // Weights differ by the coordinates' errors, and interpolated values lie in [0, 1].
    constexpr float interpolated = 2 * coordinate_error;
    if (methods::traits(job).has_exact_causes()) {
        return interpolated;
    }
    // p = V/(V + d²) with V = m₂ − m₁² >= 0.01: |∂p/∂V| <= 1/(4V) and |∂p/∂d| <= 3√3/(8√V). Both
    // moments differ.
    return 3 * interpolated * 25 + interpolated * 6.5F;
}

struct Named {
    std::string name;
    scene::Job job;

    friend void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }
};

std::vector<Named> lookups()
{
    std::vector<Named> all;
    const auto add = [&](std::string name) -> scene::Job& {
        return all.emplace_back(std::move(name), looking_at_quadrangles()).job;
    };
    const auto add_from_aside = [&](std::string name, Filter filter) {
        all.emplace_back(std::move(name), looking_at_quadrangles_from_aside()).job.lookup.filter =
            filter;
    };
    add_from_aside("nearest from aside", Filter::nearest);
    add_from_aside("pcf3 from aside", Filter::pcf3);
    for (const auto& [name, filter] :
         std::vector<std::pair<std::string, Filter>>{{"nearest", Filter::nearest},
                                                     {"linear", Filter::linear},
                                                     {"pcf3", Filter::pcf3},
                                                     {"hardware", Filter::hardware}}) {
        add(name).lookup.filter = filter;
    }
    scene::Job& moved = add("normal offset");
    moved.lookup.filter = Filter::pcf3;
    moved.bias.normal_texels = 1.5;
    scene::MethodSettings variances{.name = "vsm"};
    variances.values["method.min_variance"] = 0.01;
    add("variances").method = variances;
    scene::Job& sampled = add("variances of samples");
    sampled.method = variances;
    sampled.method.values["method.samples"] = std::int64_t{4};
    sampled.method.values["method.mips"] = true;
    scene::Job& reversed = add("reversed, 16 bits");
    reversed.shadow_map.frustum.reversed = true;
    reversed.shadow_map.depth_format = {scene::DepthFormat::Kind::d16, 16};
    return all;
}

class SeveralMaps : public testing::TestWithParam<Named> {};

/// Expects equal texels, depths, verdicts and causes of a pixel.
void expect_same(const BothLayouts& both, std::size_t pixel)
{
    const auto& [whole, quarters] = both;
    const scene::MapPoint at = quarters.lookup.at(pixel);
    const Texel texel{static_cast<int>(at.texel.x), static_cast<int>(at.texel.y), at.map};
    const Texel in_whole{static_cast<int>(whole.lookup.texels[pixel].x),
                         static_cast<int>(whole.lookup.texels[pixel].y), 0};
    ASSERT_EQ(texel_of_whole(texel, quarters.job.shadow_map.resolution_texels), in_whole);
    const scene::LookupSample& expected = whole.lookup.samples[pixel];
    const scene::LookupSample& found = quarters.lookup.samples[pixel];
    ASSERT_EQ(found.receiver_depth, expected.receiver_depth);
    const float tolerance = tolerance_of(whole.job);
    ASSERT_NEAR(found.map_depth, expected.map_depth, tolerance);
    if (methods::traits(whole.job).has_fractions()) {
        ASSERT_NEAR(found.verdict, expected.verdict, tolerance);
    }
    const float own_bias = whole.diagnosis->biases->critical_bias[pixel];
    const bool is_certain =
        std::abs(own_bias) > tolerance && std::abs(own_bias - whole.view.bias.constant) > tolerance;
    const bool is_one_comparison = whole.job.lookup.filter != Filter::hardware &&
                                   methods::traits(whole.job).has_exact_causes();
    if (!is_one_comparison || !is_certain) {
        return;
    }
    ASSERT_EQ(found.verdict, expected.verdict);
    ASSERT_EQ(quarters.diagnosis->causes.cause[pixel], whole.diagnosis->causes.cause[pixel]);
    ASSERT_EQ(quarters.diagnosis->causes.label[pixel], whole.diagnosis->causes.label[pixel]);
    ASSERT_NEAR(quarters.diagnosis->biases->critical_bias[pixel], own_bias, tolerance);
    if (!std::isnan(whole.diagnosis->map_error_m[pixel])) {
        ASSERT_NEAR(quarters.diagnosis->map_error_m[pixel], whole.diagnosis->map_error_m[pixel],
                    double{tolerance} * whole.view.first_map().range_m());
    }
}

TEST_P(SeveralMaps, GiveWhatOneMapOfTheSameGridGives)
{
    GNOMON_REQUIRE_GL();
    std::size_t compared = 0;
    std::size_t wrong = 0;
    std::size_t otherwise_explained = 0;
    std::uint64_t errors = 0;
    const std::uint32_t scenes = in_lane(1U, 3U);
    for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
        const Compared scene{tilted_quadrangles(seed)};
        const BothLayouts both = compare_both(scene, GetParam().job);
        for (std::size_t i = 0; i < both.whole.lookup.samples.pixel_count(); ++i) {
            if (scene::is_scored(both.whole.truth.pixel_class[i]) &&
                is_away_from_borders(both.whole, i)) {
                SCOPED_TRACE(testing::Message() << "seed " << seed << ", pixel " << i);
                expect_same(both, i);
                ASSERT_FALSE(HasFatalFailure());
                ++compared;
                const auto& expected = both.whole.diagnosis->causes;
                const auto& found = both.quarters.diagnosis->causes;
                wrong += expected.cause[i] != analysis::Cause::none ? 1U : 0U;
                otherwise_explained +=
                    expected.cause[i] != found.cause[i] || expected.label[i] != found.label[i] ? 1U
                                                                                               : 0U;
            }
        }
        errors += both.quarters.metrics.false_shadow + both.quarters.metrics.false_lit;
    }
    EXPECT_GT(3 * compared, 20'000U * scenes);
    EXPECT_GT(3 * errors, 50U * scenes);
    // Causes may differ only if a verdict is within the tolerance of a threshold.
    EXPECT_GT(3 * wrong, 25U * scenes);
    EXPECT_LE(otherwise_explained, wrong / 50) << wrong << " pixels with a cause";
}

INSTANTIATE_TEST_SUITE_P(Of, SeveralMaps, testing::ValuesIn(lookups()), [](const auto& named) {
    std::string name = named.param.name;
    std::erase_if(name, [](char c) { return !std::isalnum(c); });
    return name;
});

TEST(SeveralMaps, StoreTheDepthsOfOneMapOfTheSameGrid)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job = looking_at_quadrangles();
    const scene::SceneFile file = tilted_quadrangles(4);
    const scene::View view = scene::resolve_view(job, file.scene, file.defaults);
    const raster_gl::GpuScene gpu{*shared_context(), file.scene};
    raster_gl::ShadowMapPass pass{*shared_context()};
    const auto depths_of = [&](const scene::Job& drawn, const scene::View& of) {
        return read_shader_depths(*shared_context(), pass.render(gpu, of.maps, drawn.shadow_map));
    };
    const scene::Image<float> whole = depths_of(job, view);
    const scene::Image<float> quarters = depths_of(of_quarters(job), in_quadrants(view));
    const int half = job.shadow_map.resolution_texels / 2;
    ASSERT_EQ(quarters.size(), scene::maps_image_size(half, 4));
    std::size_t casters = 0;
    for (int map = 0; map < 4; ++map) {
        for (int y = 0; y < half; ++y) {
            for (int x = 0; x < half; ++x) {
                const Texel texel{x, y, map};
                const float depth = at_texel(whole, texel_of_whole(texel, half));
                ASSERT_EQ(at_texel(quarters, texel), depth)
                    << "texel (" << x << ", " << y << ") of map " << map;
                casters += depth < at_texel(whole, {0, 0, 0}) ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(casters, 1000U);
}

TEST(SeveralMaps, HoldTheirVerdictsToTheCurve)
{
    GNOMON_REQUIRE_GL();
    for (const char* builtin : {"sphere-plane", "columns"}) {
        for (const char* filter : {"nearest", "pcf3", "hardware"}) {
            if (!runs_full_tests() && (*filter == 'p') != (*builtin == 'c')) {
                continue; // the usual lane tries each filter and each scene once
            }
            SCOPED_TRACE(testing::Message() << builtin << ", " << filter);
            const scene::Job job = tests::builtin_job(builtin, {{"shadow_map.resolution", "256"},
                                                                {"lookup.filter", filter},
                                                                {"lookup.position", "pixel"},
                                                                {"image.width", "320"},
                                                                {"image.height", "180"}})
                                       .job;
            const Compared scene{job};
            const auto verified =
                verify_comparison(compare_quarters(scene, job), scene.renderers());
            ASSERT_TRUE(verified);
            EXPECT_GT(verified->verdicts(), 0U);
            EXPECT_EQ(verified->differences(), 0U);
        }
    }
}

TEST(SeveralMaps, AreRefusedWhereTheyAreLookedUpFromVertices)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane", {{"lookup.position", "vertex"}}};
    c.view = in_quadrants(c.view);
    c.draw_receivers();
    c.draw_shadow_map();
    EXPECT_THROW(c.look_up(), std::invalid_argument);
}

TEST(SeveralMaps, AreRefusedWhereOthersWereDrawn)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane", {{"lookup.position", "pixel"}}};
    c.draw_receivers();
    c.draw_shadow_map();
    c.view = in_quadrants(c.view);
    EXPECT_THROW(c.look_up(), std::invalid_argument);
}

TEST(AnExactLight, RefusesTexelsOfMapsThatItHasNot)
{
    const scene::Job job = looking_at_quadrangles();
    const scene::SceneFile file = tilted_quadrangles(5);
    const scene::View view = in_quadrants(scene::resolve_view(job, file.scene, file.defaults));
    const reference_rt::ReferenceScene reference{file.scene};
    const scene::Image<std::uint32_t> receivers{view.image, scene::no_triangle};
    const auto light =
        reference_rt::make_light_queries(reference, view, receivers, 8, scene::Cull::none);
    constexpr std::array<Texel, 1> there{{{0, 0, 3}}};
    constexpr std::array<Texel, 1> beyond{{{0, 0, 4}}};
    EXPECT_EQ(light->first_hits(there, renderers::HitDetail::placed).size(), 1U);
    EXPECT_THROW((void)light->first_hits(beyond, renderers::HitDetail::placed),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::tests
