// Filters that gather comparisons: GL's verdict is the weighted share of lit taps, computed on the
// CPU.

#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "gl_case.hpp"
#include "scene/pixels/map_texels.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

/// The lit and the total weight of a lookup, from depths that were read back.
struct LitWeight {
    double lit = 0;
    double all = 0;
};

LitWeight lit_weight(const std::vector<analysis::Tap>& taps, const analysis::LookupRule& rule,
                     const scene::Image<float>& depths, float receiver_depth, float bias)
{
    LitWeight weight;
    for (const analysis::Tap& tap : taps) {
        const float d = tap.is_inside ? at_texel(depths, tap.texel) : rule.outside_depth();
        weight.lit += rule.is_lit(receiver_depth, d, bias) ? tap.weight : 0;
        weight.all += tap.weight;
    }
    return weight;
}

/// @return  how many verdicts lie between 0 and 1.
std::size_t expect_shares(GlCase& c)
{
    c.draw_all();
    const auto depths = read_shader_depths(*shared_context(), *c.map);
    const auto lookup = c.lookup_pass.read();
    const auto triangles = read_triangles(*shared_context(), *c.receivers);
    const analysis::LookupRule rule = analysis::lookup_rule(c.job, c.view);
    const analysis::Footprint footprint{rule.traits, rule.edge(), c.map->resolution_texels};
    std::size_t between = 0;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        const scene::LookupSample& sample = lookup.samples[i];
        const auto taps = footprint.taps(lookup.at(i));
        if (triangles[i] == scene::no_triangle ||
            rule.border_decides(sample.receiver_depth, taps)) {
            continue;
        }
        const LitWeight weight =
            lit_weight(taps, rule, depths, sample.receiver_depth, c.view.bias.constant);
        // A weight rounds five times; numerator and denominator have at most 64 sums each.
        EXPECT_NEAR(sample.verdict, weight.lit / weight.all, 2 * 70 * 0x1p-24) << "pixel " << i;
        EXPECT_EQ(sample.verdict == 1, weight.lit == weight.all) << "pixel " << i;
        if (testing::Test::HasFailure()) {
            return 0;
        }
        between += weight.lit > 0.1 * weight.all && weight.lit < 0.9 * weight.all ? 1U : 0U;
    }
    return between;
}

const std::vector<const char*> bilinear_filters{"bilinear3", "bilinear5", "bilinear7"};

TEST(BilinearFilters, WeighTheirComparisonsInFloat32)
{
    GNOMON_REQUIRE_GL();
    for (const char* const filter : bilinear_filters) {
        for (const char* const outside : {"lit", "shadowed", "clamp"}) {
            for (const char* const reversed : {"false", "true"}) {
                SCOPED_TRACE(testing::Message()
                             << filter << ' ' << outside << " reversed " << reversed);
                GlCase c{"sphere-plane",
                         {{"image.width", "320"},
                          {"image.height", "180"},
                          {"shadow_map.resolution", "100"},
                          {"shadow_map.reversed", reversed},
                          {"lookup.filter", filter},
                          {"lookup.outside", outside},
                          {"bias.constant", "0.0007"}}};
                EXPECT_GT(expect_shares(c), 100U);
            }
        }
    }
}

TEST(BilinearFilters, ReadOverACubesSeams)
{
    GNOMON_REQUIRE_GL();
    for (const char* const filter : bilinear_filters) {
        SCOPED_TRACE(filter);
        GlCase c{"lamp-room",
                 {{"image.width", "320"},
                  {"image.height", "180"},
                  {"shadow_map.resolution", "48"},
                  {"lookup.filter", filter}}};
        EXPECT_GT(expect_shares(c), 100U);
    }
}

} // namespace
} // namespace gnomon::tests
