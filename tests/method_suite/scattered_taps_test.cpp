// Kernels with scattered taps: the CPU finds the texels that GL reads, so causes are exact, and
// curves match GL's reruns.

#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "compared.hpp"
#include "gl_case.hpp"
#include "lane.hpp"
#include "methods/job_method.hpp"
#include "methods_job.hpp"
#include "scene/job/file.hpp"
#include "scene/pixels/map_texels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

using Keys = std::vector<scene::Override>;

Keys with(Keys keys, const Keys& more)
{
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

const Keys small{{"image.width", "240"}, {"image.height", "135"}, {"method.name", "pcf"}};
/// Small images, because exact rays answer every tap.
const Keys tiny{{"image.width", in_lane("64", "120")},
                {"image.height", in_lane("36", "68")},
                {"method.name", "pcf"}};

struct Kernel {
    const char* name;
    Keys keys;
};

const std::vector<Kernel>& kernels()
{
    static const std::vector<Kernel> all{
        {"grid", {{"method.radius_texels", "2.5"}}},
        {"poisson",
         {{"method.pattern", "poisson"}, {"method.taps", "16"}, {"method.turned", "true"}}},
        {"vogel",
         {{"method.pattern", "vogel"},
          {"method.taps", "21"},
          {"method.radius_texels", "4.25"},
          {"method.weights", "gaussian"},
          {"method.turned", "true"}}},
        {"metres", {{"method.radius_m", "0.15"}, {"method.turned", "true"}}},
        {"tent in metres",
         {{"method.radius_m", "0.1"}, {"method.pattern", "vogel"}, {"method.weights", "tent"}}},
        {"bilinear, as engines have it",
         {{"method.pattern", "vogel_areas"},
          {"method.taps", "5"},
          {"method.radius_texels", "1"},
          {"method.tap", "bilinear"},
          {"method.turned", "true"}}},
        {"bilinear, weighted",
         {{"method.tap", "bilinear"},
          {"method.weights", "tent"},
          {"method.radius_texels", "3.5"}}}};
    return all;
}

struct Layout {
    const char* name;
    const char* builtin;
    Keys keys;
};

const std::vector<Layout>& layouts()
{
    static const std::vector<Layout> all{
        {"one map", "sphere-plane", {{"shadow_map.resolution", "128"}}},
        {"reversed, beyond the map",
         "two-distances",
         {{"shadow_map.resolution", "128"},
          {"shadow_map.reversed", "true"},
          {"shadow_map.fit", "fixed"},
          {"shadow_map.fov_deg", "30"},
          {"lookup.outside", "shadowed"}}},
        {"cube", "lamp-room", {{"shadow_map.resolution", "48"}}},
        {"cascades",
         "yard",
         {{"shadow_map.resolution", "128"},
          {"shadow_map.layout", "cascades"},
          {"shadow_map.cascades", "3"},
          {"lookup.outside", "clamp"}}}};
    return all;
}

/// The share of lit taps, from depths that were read back; exact for integer weights.
float share_of(const std::vector<analysis::Tap>& taps, const analysis::LookupRule& rule,
               const scene::Image<float>& depths, float receiver_depth, float bias)
{
    double lit = 0;
    double all = 0;
    for (const analysis::Tap& tap : taps) {
        const float d = tap.is_inside ? at_texel(depths, tap.texel) : rule.outside_depth();
        lit += rule.is_lit(receiver_depth, d, bias) ? tap.weight : 0;
        all += tap.weight;
    }
    return static_cast<float>(lit / all);
}

void expect_shares(GlCase& c)
{
    c.draw_all();
    const auto depths = read_shader_depths(*shared_context(), *c.map);
    const auto lookup = c.lookup_pass.read();
    const auto triangles = read_triangles(*shared_context(), *c.receivers);
    const analysis::LookupRule rule = analysis::lookup_rule(c.job, c.view);
    const analysis::Footprint footprint{rule.traits, rule.edge(), c.map->resolution_texels};
    // Four roundings of a tap's mean, one of its weight, one sum per tap, and the division, for lit
    // and total weight.
    const double tolerance =
        rule.traits.taps.are_interpolated
            ? 2 * (6 + static_cast<double>(rule.traits.taps.places.size())) * 0x1p-24
            : 0;
    std::size_t between = 0;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        const scene::LookupSample& sample = lookup.samples[i];
        const auto taps = footprint.taps(lookup.at(i));
        if (triangles[i] == scene::no_triangle ||
            rule.border_decides(sample.receiver_depth, taps)) {
            continue;
        }
        const float bias = c.view.bias.constant * rule.bias_scale(scene::map_of(lookup.maps, i)) +
                           c.view.bias.slope * sample.tan_theta;
        const float share = share_of(taps, rule, depths, sample.receiver_depth, bias);
        ASSERT_NEAR(sample.verdict, share, tolerance)
            << "pixel " << i << " at " << lookup.texels[i].x << ' ' << lookup.texels[i].y;
        between += share > 0.1F && share < 0.9F ? 1U : 0U;
    }
    EXPECT_GT(between, 100U);
}

TEST(ScatteredTaps, AreTheSameInGlsl)
{
    GNOMON_REQUIRE_GL();
    for (const Layout& layout : layouts()) {
        for (const Kernel& kernel : kernels()) {
            SCOPED_TRACE(std::string{layout.name} + ", " + kernel.name);
            GlCase c{layout.builtin, with(with(small, layout.keys), kernel.keys)};
            expect_shares(c);
        }
    }
}

TEST(ScatteredTaps, OfAGridOfWholeTexelsAreThoseOfTheSquareFilters)
{
    GNOMON_REQUIRE_GL();
    for (const Layout& layout : layouts()) {
        for (const int half : {1, 2, 3, 4}) {
            SCOPED_TRACE(std::string{layout.name} + ", " + std::to_string(half));
            const std::string across = std::to_string(2 * half + 1);
            const std::string taps = std::to_string((2 * half + 1) * (2 * half + 1));
            GlCase kernel{layout.builtin, with(with(small, layout.keys),
                                               {{"method.taps", taps},
                                                {"method.radius_texels", std::to_string(half)}})};
            Keys keys = with(with(small, layout.keys), {{"lookup.filter", "pcf" + across}});
            std::erase_if(keys,
                          [](const scene::Override& key) { return key.key == "method.name"; });
            GlCase square{layout.builtin, keys};
            kernel.draw_all();
            square.draw_all();
            const auto found = kernel.lookup_pass.read().samples;
            const auto expected = square.lookup_pass.read().samples;
            for (std::size_t i = 0; i < found.pixel_count(); ++i) {
                ASSERT_EQ(found[i].verdict, expected[i].verdict) << "pixel " << i;
            }
        }
    }
}

TEST(ScatteredTaps, ThatAreBilinearAreTheMeanOfAsManyHardwareLookups)
{
    GNOMON_REQUIRE_GL();
    // Of a grid of ±1 texel: each row and column of four centres is weighed 1 − f, 1, 1, f, as
    // three linear kernels beside each other do. The order of sums differs: nine taps' roundings
    // and six.
    GlCase kernel{"sphere-plane", with(small, {{"method.taps", "9"},
                                               {"method.radius_texels", "1"},
                                               {"method.tap", "bilinear"}})};
    kernel.draw_all();
    const auto depths = read_shader_depths(*shared_context(), *kernel.map);
    const auto lookup = kernel.lookup_pass.read();
    const analysis::LookupRule rule = analysis::lookup_rule(kernel.job, kernel.view);
    std::size_t between = 0;
    for (std::size_t i = 0; i < lookup.samples.pixel_count(); ++i) {
        const scene::LookupSample& sample = lookup.samples[i];
        const double x = double{lookup.texels[i].x} - 0.5;
        const double y = double{lookup.texels[i].y} - 0.5;
        const auto left = static_cast<int>(std::floor(x)) - 1;
        const auto low = static_cast<int>(std::floor(y)) - 1;
        const auto at_side = [&](int texel) {
            return texel < 1 || texel + 4 >= kernel.map->resolution_texels;
        };
        if (std::isnan(sample.map_depth) || !(sample.receiver_depth > 0) || at_side(left) ||
            at_side(low)) {
            continue;
        }
        const double right_share = x - std::floor(x);
        const double upper_share = y - std::floor(y);
        const double columns[]{1 - right_share, 1, 1, right_share};
        const double rows[]{1 - upper_share, 1, 1, upper_share};
        const float bias = kernel.view.bias.constant + kernel.view.bias.slope * sample.tan_theta;
        double lit = 0;
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                const float d = at_texel(depths, {left + column, low + row, 0});
                lit +=
                    rule.is_lit(sample.receiver_depth, d, bias) ? columns[column] * rows[row] : 0;
            }
        }
        // Places of taps beside the texel looked up are rounded to float32 near 1024: by 2^-15.
        ASSERT_NEAR(sample.verdict, lit / 9, 4 * 0x1p-15) << "pixel " << i;
        between += lit > 1 && lit < 8 ? 1U : 0U;
    }
    EXPECT_GT(between, 100U);
}

TEST(ScatteredTaps, AreTurnedByAnglesOfEachPixelsOwn)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane",
             with(small, {{"method.turned", "true"}, {"method.radius_texels", "3"}})};
    c.draw_all();
    const auto lookup = c.lookup_pass.read();
    const auto triangles = read_triangles(*shared_context(), *c.receivers);
    std::vector<std::size_t> of_angle(64, 0);
    std::size_t all = 0;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        if (triangles[i] == scene::no_triangle) {
            continue;
        }
        const scene::Vec2f axis = lookup.kernel_axes[i];
        // Cosine and sine are rounded, and so are their products with the radius.
        ASSERT_NEAR(std::hypot(axis.x, axis.y), 3, 3 * 0x1p-22);
        const double turns = std::atan2(double{axis.y}, double{axis.x}) / (2 * std::acos(-1.0));
        const long angle = std::lround(64 * turns);
        ASSERT_NEAR(64 * turns, static_cast<double>(angle), 1e-4);
        ++of_angle[static_cast<std::size_t>((angle + 64) % 64)];
        ++all;
    }
    // Each about as often: of n / 64 expected, √n / 8 is one standard deviation; ten are allowed.
    const double expected = static_cast<double>(all) / 64;
    for (const std::size_t count : of_angle) {
        EXPECT_NEAR(static_cast<double>(count), expected, 10 * std::sqrt(expected));
    }
}

TEST(ScatteredTaps, HaveARadiusInMetresAtTheReceiver)
{
    GNOMON_REQUIRE_GL();
    for (const Layout& layout : layouts()) {
        SCOPED_TRACE(layout.name);
        GlCase c{layout.builtin, with(with(small, layout.keys), {{"method.radius_m", "0.125"}})};
        c.draw_all();
        const auto lookup = c.lookup_pass.read();
        const auto triangles = read_triangles(*shared_context(), *c.receivers);
        const auto positions = read_world_positions(*shared_context(), *c.receivers);
        for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
            if (triangles[i] == scene::no_triangle) {
                continue;
            }
            const scene::LightFrustum& map =
                c.view.maps.at(static_cast<std::size_t>(scene::map_of(lookup.maps, i)));
            const double distance_m = map.light_distance_m(scene::Vec3d{positions[i]});
            const double width_m = map.texel_width_m(distance_m, c.map->resolution_texels);
            if (distance_m > 0) {
                // ζ is a float32 sum of products up to ten times itself.
                ASSERT_NEAR(lookup.kernel_axes[i].x, std::min(0.125 / width_m, 64.0), 1e-4 * 64)
                    << "pixel " << i;
            }
            ASSERT_EQ(lookup.kernel_axes[i].y, 0);
        }
    }
}

/// The curve is GL's own at other biases, and every error has one cause.
void expect_exact_answers(const Layout& layout, const Kernel& kernel)
{
    const scene::Job job =
        tests::builtin_job(layout.builtin, with(with(tiny, layout.keys), kernel.keys)).job;
    const Compared scene{job};
    const auto result = scene(job);
    ASSERT_TRUE(result.held.has_value());
    EXPECT_EQ(result.held->differences, 0U);
    EXPECT_TRUE(methods::traits(job).has_exact_causes());
    const auto& causes = result.diagnosis->causes;
    std::uint64_t explained = 0;
    for (const std::uint64_t count : causes.counts.by_cause) {
        explained += count;
    }
    EXPECT_EQ(explained, result.metrics.false_shadow + result.metrics.false_lit);
    const auto verified = verify_comparison(result, scene.renderers());
    ASSERT_TRUE(verified.has_value());
    for (const auto& rerun : verified->reruns) {
        EXPECT_EQ(rerun.differences, 0U) << "bias " << rerun.bias;
    }
}

/// Every kernel in one layout, and every layout.
TEST(ScatteredTaps, HaveExactCausesAndTheCurveOfGlsReruns)
{
    GNOMON_REQUIRE_GL();
    for (std::size_t i = 0; i < kernels().size(); ++i) {
        const Layout& layout = layouts()[i % layouts().size()];
        SCOPED_TRACE(std::string{layout.name} + ", " + kernels()[i].name);
        expect_exact_answers(layout, kernels()[i]);
    }
}

TEST(LongScatteredTaps, HaveExactCausesAndTheCurveOfGlsRerunsInEveryLayout)
{
    GNOMON_REQUIRE_GL();
    for (const Layout& layout : layouts()) {
        for (const Kernel& kernel : kernels()) {
            SCOPED_TRACE(std::string{layout.name} + ", " + kernel.name);
            expect_exact_answers(layout, kernel);
        }
    }
}

} // namespace
} // namespace gnomon::tests
