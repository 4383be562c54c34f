#include "analysis/bias/amount_rows.hpp"
#include "analysis/bias/bias_verification.hpp"
#include "analysis/lookup/bias_order.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/taps.hpp"
#include "analysis/metrics/metrics.hpp"
#include "gl_case.hpp"
#include "lane.hpp"
#include "methods/depth/depth_map.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

/// GL's lookup with any other bias gives the verdicts that the critical biases of one lookup
/// predict, in every pixel.
namespace gnomon::tests {
namespace {

/// Together the scenes have all light types, both depth directions, every border mode, a normal
/// offset, and receivers beyond the map.
struct Setting {
    const char* builtin;
    std::vector<scene::Override> keys;
    bool has_border_pixels = false; ///< receivers whose verdict no bias changes
};

const std::vector<Setting>& settings()
{
    static const std::vector<Setting> all{
        {"sphere-plane", {{"lookup.outside", "clamp"}}},
        {"terrain",
         {{"shadow_map.reversed", "true"},
          {"lookup.outside", "lit"},
          {"bias.normal_texels", "1.5"}}},
        {"two-distances",
         {{"shadow_map.fit", "fixed"},
          {"shadow_map.fov_deg", "30"},
          {"lookup.outside", "shadowed"}},
         true},
        {"columns",
         {{"shadow_map.fit", "fixed"},
          {"shadow_map.half_extent", "3"},
          {"shadow_map.reversed", "true"},
          {"lookup.outside", "lit"}},
         true},
        {"yard", {{"lookup.outside", "shadowed"}, {"lookup.position", "pixel"}}},
        {"wall", {{"lookup.outside", "lit"}}},
        {"lamp-room", {{"shadow_map.resolution", "128"}}},
        {"columns",
         {{"shadow_map.layout", "cascades"},
          {"shadow_map.resolution", "128"},
          {"shadow_map.reversed", "true"},
          {"bias.constant_m", "0.02"}}},
        {"terrain",
         {{"shadow_map.layout", "cascades"},
          {"shadow_map.resolution", "128"},
          {"shadow_map.select", "containing"},
          {"bias.constant", "0.001"},
          {"bias.normal_texels", "0.5"}}}};
    return all;
}

std::vector<scene::Override> keys_of(const Setting& setting, const char* format, const char* filter,
                                     const char* slope)
{
    std::vector<scene::Override> keys{{"image.width", in_lane("160", "320")},
                                      {"image.height", in_lane("90", "180")},
                                      {"shadow_map.resolution", "256"},
                                      {"shadow_map.depth_format", format},
                                      {"lookup.filter", filter},
                                      {"bias.slope", slope}};
    keys.insert(keys.end(), setting.keys.begin(), setting.keys.end());
    return keys;
}

/// 0; then half of the biases in a geometric sequence up to the largest critical bias, and half at,
/// just below and just above critical biases.
std::vector<float> biases_to_try(std::vector<float> criticals, std::size_t count)
{
    std::erase_if(criticals, [](float critical) { return !std::isfinite(critical); });
    std::sort(criticals.begin(), criticals.end());
    std::vector<float> biases{0.0F};
    if (criticals.empty()) {
        return biases;
    }
    const float largest = std::max(criticals.back(), 1e-3F);
    const std::size_t half = count / 2;
    for (std::size_t i = 0; i < half; ++i) {
        const double share = static_cast<double>(i + 1) / static_cast<double>(half);
        biases.push_back(static_cast<float>(double{largest} * std::pow(1e-7, 1.0 - share)));
    }
    std::mt19937 random{1};
    for (std::size_t i = 0; i < half; ++i) {
        const float critical = criticals[random() % criticals.size()];
        biases.push_back(i % 3 == 0   ? critical
                         : i % 3 == 1 ? analysis::previous_bias(critical)
                                      : analysis::next_bias(critical));
    }
    return biases;
}

using AmountsByBias = std::map<float, analysis::ErrorAmounts>;

/// The errors of GL's verdicts.
analysis::ErrorAmounts amounts_of(const scene::LookupLayers& lookup,
                                  const scene::Image<scene::PixelClass>& classes, int taps)
{
    const scene::Truth truth{classes, scene::Image<scene::ClassReason>{classes.size()},
                             scene::Image<std::uint32_t>{classes.size()}};
    return analysis::measure(truth, lookup, taps).amounts;
}

/// GL's lookup with a bias.
/// @param amounts  Receives the errors against `classes` by bias.
std::function<scene::LookupLayers(float)>
lookups_of(GlCase& c, const scene::Image<scene::PixelClass>& classes, AmountsByBias& amounts)
{
    return [&](float constant) {
        c.view.bias.constant = constant;
        c.look_up();
        auto lookup = c.lookup_pass.read();
        amounts[constant] =
            amounts_of(lookup, classes, methods::filter_traits(c.job.lookup.filter).equal_taps());
        return lookup;
    };
}

/// An arbitrary truth: two thirds of the receivers are lit.
scene::Image<scene::PixelClass> some_truth(const scene::Image<std::uint32_t>& triangles)
{
    scene::Image<scene::PixelClass> classes{triangles.size(), scene::PixelClass::background};
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (triangles[i] != scene::no_triangle) {
            classes[i] = i % 3 == 0 ? scene::PixelClass::blocked : scene::PixelClass::lit;
        }
    }
    return classes;
}

/// Expects the amounts of the bias curve to equal GL's.
void expect_amounts(const AmountsByBias& measured, const scene::Image<scene::PixelClass>& classes,
                    const analysis::TapCriticals& taps, const std::string& label)
{
    std::vector<float> biases;
    for (const auto& [bias, amounts] : measured) {
        biases.push_back(bias);
    }
    const auto known = analysis::sum_amounts(classes, taps, biases);
    for (std::size_t i = 0; i < biases.size(); ++i) {
        EXPECT_EQ(known[i], measured.at(biases[i])) << label << " bias " << biases[i];
    }
}

/// The critical biases that GL finds by bisection.
scene::Image<float> bisected(GlCase& c)
{
    return c.lookup_pass.find_critical_biases(c.looked_up(), c.job, c.view);
}

/// @return  The number of receivers whose verdict the border decides.
std::size_t expect_identity(GlCase& c, const std::string& label)
{
    c.draw_all();
    const analysis::LookupRule rule = analysis::lookup_rule(c.job, c.view);
    const auto lookup = c.lookup_pass.read();
    const auto depths = read_shader_depths(*shared_context(), *c.map);
    const auto criticals = rule.traits.has_formula()
                               ? analysis::critical_biases(
                                     analysis::deciding_samples(lookup, lookup, depths, rule), rule)
                               : bisected(c);
    const auto triangles = read_triangles(*shared_context(), *c.receivers);
    std::vector<float> seen;
    for (std::size_t i = 0; i < criticals.pixel_count(); ++i) {
        if (triangles[i] != scene::no_triangle) {
            seen.push_back(criticals[i]);
        }
    }
    const auto classes = some_truth(triangles);
    AmountsByBias amounts;
    const auto verification =
        analysis::verify_biases(triangles, criticals, biases_to_try(seen, in_lane(6U, 1000U)),
                                lookups_of(c, classes, amounts));
    if (rule.traits.equal_taps() > 1) {
        expect_amounts(amounts, classes, {lookup, depths, rule}, label);
    }
    std::uint64_t lit = 0;
    std::uint64_t shadowed = 0;
    for (const auto& rerun : verification.reruns) {
        EXPECT_EQ(rerun.differences, 0U) << label << " bias " << rerun.bias;
        lit += rerun.lit;
        shadowed += rerun.shadowed;
    }
    EXPECT_GT(std::min(lit, shadowed), 1000U) << label;
    return static_cast<std::size_t>(std::count_if(
        seen.begin(), seen.end(), [](float critical) { return std::isinf(critical); }));
}

/// Some formats of each kind that a filter can sample.
std::vector<std::string> formats_with(const std::string& filter)
{
    std::vector<std::string> formats{"d16", "d24", "d32f", "u12"};
    if (filter != "hardware") { // GL compares only with depth formats
        formats.insert(formats.end(), {"r32f", "r16f"});
    }
    if (filter != "hardware" && filter != "linear") { // packed bytes cannot be interpolated
        formats.emplace_back("rgba8");
    }
    return formats;
}

/// The usual lane tries the two slopes in turn.
std::vector<const char*> slopes(std::size_t number)
{
    if (runs_full_tests()) {
        return {"0", "0.002"};
    }
    return {number % 2 == 0 ? "0" : "0.002"};
}

class BiasIdentity : public testing::TestWithParam<std::tuple<std::size_t, const char*>> {};

TEST_P(BiasIdentity, HoldsForGlsOwnRerunInEveryPixel)
{
    GNOMON_REQUIRE_GL();
    const auto& [index, filter] = GetParam();
    const Setting& setting = settings()[index];
    GlCase c{setting.builtin, keys_of(setting, "d16", filter, "0")};
    std::size_t number = index;
    for (const std::string& format : formats_with(filter)) {
        for (const char* slope : slopes(number++)) {
            c.set(keys_of(setting, format.c_str(), filter, slope));
            expect_identity(
                c, fmt::format("{} {} {} slope {}", setting.builtin, filter, format, slope));
        }
    }
}

/// Each scene with each filter. The usual lane tries each filter in half of the scenes.
std::vector<std::tuple<std::size_t, const char*>> scenes_and_filters()
{
    std::vector<std::tuple<std::size_t, const char*>> all;
    std::size_t number = 0;
    for (std::size_t index = 0; index < settings().size(); ++index, ++number) {
        for (const char* const filter : {"nearest", "linear", "hardware", "pcf3", "pcf5", "pcf9"}) {
            if (runs_full_tests() || number++ % 2 == 0) {
                all.emplace_back(index, filter);
            }
        }
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(ScenesAndFilters, BiasIdentity, testing::ValuesIn(scenes_and_filters()));

/// `linear` cannot interpolate distances.
class BiasIdentityOfDistances : public testing::TestWithParam<const char*> {};

TEST_P(BiasIdentityOfDistances, HoldsForGlsOwnRerunInEveryPixel)
{
    GNOMON_REQUIRE_GL();
    for (const auto& [builtin, content] : {std::pair{"lamp-room", "distance"},
                                           {"sphere-plane", "distance"},
                                           {"sphere-plane", "linear"}}) {
        const Setting setting{builtin, {{"shadow_map.content", content}}};
        GlCase c{builtin, keys_of(setting, "d32f", GetParam(), "0")};
        std::size_t number = 0;
        for (const std::string& format : formats_with(GetParam())) {
            for (const char* slope : slopes(number++)) {
                c.set(keys_of(setting, format.c_str(), GetParam(), slope));
                expect_identity(c, fmt::format("{} {} {} {} slope {}", builtin, content, GetParam(),
                                               format, slope));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Filters, BiasIdentityOfDistances,
                         testing::Values("nearest", "hardware", "pcf3", "pcf9"));

class BiasIdentityOfMixedVerdicts : public testing::TestWithParam<const char*> {};

/// For every share of light from which a pixel may count as lit, so that amounts follow too.
TEST_P(BiasIdentityOfMixedVerdicts, HoldsForGlsOwnRerunInEveryPixel)
{
    GNOMON_REQUIRE_GL();
    for (const Setting& setting : {Setting{"columns", {{"bias.constant_m", "0.02"}}},
                                   Setting{"terrain", {{"bias.slope", "0.002"}}}}) {
        auto keys = keys_of(setting, "d24", GetParam(), "0");
        keys.push_back({"shadow_map.layout", "cascades"});
        keys.push_back({"shadow_map.blend", "0.1"});
        keys.push_back({"shadow_map.resolution", "128"});
        GlCase c{setting.builtin, keys};
        c.draw_all();
        EXPECT_FALSE(analysis::lookup_rule(c.job, c.view).traits.has_formula());
        const auto triangles = read_triangles(*shared_context(), *c.receivers);
        std::vector<std::pair<float, scene::Image<float>>> levels;
        std::vector<float> seen;
        for (const float lit_from : {0.01F, 0.25F, 0.5F, 0.75F, 1.0F}) {
            levels.emplace_back(lit_from, c.lookup_pass.find_critical_biases(
                                              c.looked_up(), c.job, c.view, {lit_from, {}}));
            for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
                if (triangles[i] != scene::no_triangle) {
                    seen.push_back(levels.back().second[i]);
                }
            }
        }
        std::size_t fractions = 0;
        for (const float bias : biases_to_try(seen, in_lane(12U, 200U))) {
            c.view.bias.constant = bias;
            c.look_up();
            const auto samples = c.lookup_pass.read().samples;
            std::size_t different = 0;
            for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
                const float verdict = samples[i].verdict;
                fractions += verdict > 0 && verdict < 1 ? 1U : 0U;
                for (const auto& [lit_from, criticals] : levels) {
                    const bool is_seen = triangles[i] != scene::no_triangle;
                    different +=
                        is_seen && (verdict >= lit_from) != (criticals[i] <= bias) ? 1U : 0U;
                }
            }
            EXPECT_EQ(different, 0U) << setting.builtin << " " << GetParam() << " bias " << bias;
        }
        EXPECT_GT(fractions, 100U) << setting.builtin;
    }
}

INSTANTIATE_TEST_SUITE_P(Filters, BiasIdentityOfMixedVerdicts,
                         testing::Values("nearest", "linear", "hardware", "pcf3"));

class Bisection : public testing::TestWithParam<std::size_t> {};

TEST_P(Bisection, FindsWhatTheFormulaSays)
{
    GNOMON_REQUIRE_GL();
    const Setting& setting = settings()[GetParam()];
    GlCase c{setting.builtin, keys_of(setting, "d16", "nearest", "0")};
    for (const char* filter : {"nearest", "linear", "pcf3"}) {
        for (const auto& [format, slope] : {std::pair{"d24", "0"}, {"d32f", "0.002"}}) {
            SCOPED_TRACE(fmt::format("{} {} {} slope {}", setting.builtin, filter, format, slope));
            c.set(keys_of(setting, format, filter, slope));
            c.draw_all();
            const analysis::LookupRule rule = analysis::lookup_rule(c.job, c.view);
            const auto lookup = c.lookup_pass.read();
            const auto depths = read_shader_depths(*shared_context(), *c.map);
            const auto formula = analysis::critical_biases(
                analysis::deciding_samples(lookup, lookup, depths, rule), rule);
            const auto triangles = read_triangles(*shared_context(), *c.receivers);
            const auto found = bisected(c);
            std::size_t finite = 0;
            for (std::size_t i = 0; i < found.pixel_count(); ++i) {
                if (triangles[i] == scene::no_triangle) {
                    continue;
                }
                ASSERT_EQ(found[i], formula[i]) << "pixel " << i;
                finite += std::isfinite(found[i]) && found[i] != 0 ? 1U : 0U;
            }
            EXPECT_GT(finite, 1000U);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Bisection, testing::Range<std::size_t>(0, settings().size()));

} // namespace
} // namespace gnomon::tests
