// The six maps of a point light: GLSL and C++ choose the same map, and they give the verdicts of
// six spots.

#include "analysis/comparison/comparison.hpp"
#include "chosen_maps.hpp"
#include "compared.hpp"
#include "gl_case.hpp"
#include "lane.hpp"
#include "methods/depth/depth_map.hpp"
#include "methods_job.hpp"
#include "scene/job/file.hpp"
#include "scene/light/cube_faces.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tests {
namespace {

/// The keys, with a point light at a position.
std::vector<scene::Override> lit_from(const scene::Vec3d& at, std::vector<scene::Override> keys)
{
    keys.push_back({"bias.constant", "0.001"}); // in place of one in metres
    keys.push_back({"light.type", "point"});
    keys.push_back({"light.position", fmt::format("[{}, {}, {}]", at.x, at.y, at.z)});
    return keys;
}

/// A cube has no outside.
void expect_inside_faces(const GlCase& c, const scene::LookupLayers& lookup, float resolution)
{
    std::size_t outside = 0;
    visit_receivers(c, [&](std::size_t i, const scene::Vec3f&) {
        const scene::Vec2f at = lookup.texels[i];
        const bool is_inside = at.x >= 0 && at.x < resolution && at.y >= 0 && at.y < resolution;
        outside += is_inside ? 0U : 1U;
    });
    EXPECT_EQ(outside, 0U);
}

TEST(TheFaceOfACube, IsTheSameInGlslToTheBit)
{
    GNOMON_REQUIRE_GL();
    std::mt19937 random{21};
    std::uniform_real_distribution<double> metres{-2, 2};
    PixelsOfMaps pixels;
    for (const char* builtin : {"sphere-plane", "columns", "yard", "lamp-room", "terrain"}) {
        for (int i = 0; i < 4; ++i) {
            // From the third position, seams run through the room's corners.
            const scene::Vec3d at =
                i == 2 ? scene::Vec3d{0, 1, 0}
                       : scene::Vec3d{metres(random), 2 + metres(random) / 2, metres(random)};
            GlCase c{builtin, lit_from(at, {{"shadow_map.resolution", "64"},
                                            {"shadow_map.reversed", i == 1 ? "true" : "false"},
                                            {"image.width", "320"},
                                            {"image.height", "180"}})};
            SCOPED_TRACE(builtin);
            expect_chosen_maps(c, pixels);
            expect_inside_faces(c, c.lookup_pass.read(), 64);
        }
    }
    EXPECT_EQ(pixels.size(), 6U);
    expect_all_chosen(pixels, 0.02);
}

bool same_bits(float a, float b)
{
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// The view under a spot whose one map is a face of the cube. The cone holds the face's corners.
scene::View of_face(const scene::View& cube, std::size_t face)
{
    scene::View view = cube;
    view.light.type = scene::LightType::spot;
    view.light.direction = view.maps[face].forward;
    view.light.cos_half_cone = 0.1;
    view.maps = {cube.maps[face]};
    view.map_choice = scene::MapChoice::containing;
    return view;
}

TEST(SixSpots, GiveTheVerdictsOfTheFacesToTheBit)
{
    GNOMON_REQUIRE_GL();
    for (const char* format : {"d16", "d24", "d32f", "u12", "r32f", "r16f", "rgba8"}) {
        for (const auto& [reversed, content] : {std::pair{"false", "depth"},
                                                {"true", "depth"},
                                                {"false", "distance"},
                                                {"false", "linear"}}) {
            GlCase c{"lamp-room",
                     {{"image.width", "480"},
                      {"image.height", "270"},
                      {"shadow_map.resolution", "128"},
                      {"shadow_map.depth_format", format},
                      {"shadow_map.reversed", reversed},
                      {"shadow_map.content", content},
                      {"lookup.outside", "clamp"}, // the seam is the face's last texel
                      {"bias.slope", "0.0003"}}};
            c.draw_all();
            const scene::LookupLayers of_cube = c.lookup_pass.read();
            const scene::View cube = c.view;
            // As in a cube, lookups start from the pixel's position.
            c.job.lookup.position = scene::LookupPosition::pixel;
            std::size_t compared = 0;
            for (std::size_t face = 0; face < scene::cube_face_count; ++face) {
                c.view = of_face(cube, face);
                c.draw_shadow_map();
                c.look_up();
                const scene::LookupLayers of_spot = c.lookup_pass.read();
                for (std::size_t p = 0; p < of_cube.maps.pixel_count(); ++p) {
                    const auto& a = of_cube.samples[p];
                    const auto& b = of_spot.samples[p];
                    if (of_cube.maps[p] != face || a.tan_theta == 0) {
                        continue;
                    }
                    ++compared;
                    ASSERT_TRUE(same_bits(a.receiver_depth, b.receiver_depth) &&
                                same_bits(a.map_depth, b.map_depth) && a.verdict == b.verdict)
                        << format << ", face " << face << ", pixel " << p << ": r "
                        << a.receiver_depth << " and " << b.receiver_depth << ", d " << a.map_depth
                        << " and " << b.map_depth;
                }
            }
            EXPECT_GT(compared, 100'000U);
        }
    }
}

/// A receiver that a normal offset moves over a seam is looked up on the face beyond it.
TEST(ACubesNormalOffset, LeadsOverSeams)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"lamp-room",
             {{"image.width", "480"},
              {"image.height", "270"},
              {"shadow_map.resolution", "128"},
              {"bias.normal_texels", "3"}}};
    c.draw_all();
    const scene::LookupLayers moved = c.lookup_pass.read();
    expect_inside_faces(c, moved, 128);
    std::size_t over_seams = 0;
    visit_receivers(c, [&](std::size_t i, const scene::Vec3f& position) {
        over_seams += moved.maps[i] != chosen_map_of(c, position) ? 1U : 0U;
    });
    EXPECT_GT(over_seams, 100U);
}

/// Where a face has few texels, every footprint crosses seams, and most reach a corner.
TEST(ACubesLookups, AreVerdictsHoweverCoarseItsMapsAre)
{
    GNOMON_REQUIRE_GL();
    const Compared scene{tests::builtin_job("lamp-room", {}).job};
    std::size_t contents = 0;
    for (const char* resolution : {"1", "2", "3", "5"}) {
        for (const char* content : {"depth", "distance", "linear"}) {
            std::size_t number = contents++;
            for (const char* filter : {"nearest", "hardware", "pcf3", "pcf9"}) {
                if (!runs_full_tests() && number++ % 4 != 0) {
                    continue; // the usual lane tries each pair of the others with one filter
                }
                const scene::Job job =
                    tests::builtin_job("lamp-room", {{"image.width", "96"},
                                                     {"image.height", "54"},
                                                     {"shadow_map.resolution", resolution},
                                                     {"shadow_map.content", content},
                                                     {"lookup.filter", filter}})
                        .job;
                const analysis::Comparison result = scene(job);
                std::uint64_t explained = 0;
                for (const std::uint64_t pixels : result.diagnosis->causes.counts.by_cause) {
                    explained += pixels;
                }
                EXPECT_EQ(explained, result.metrics.false_shadow + result.metrics.false_lit)
                    << resolution << ' ' << content << ' ' << filter;
            }
        }
    }
}

/// On the CPU, K × K comparisons with the depths read back, also over seams, give GL's verdict.
TEST(ACubesTaps, AreTheSameInGlsl)
{
    GNOMON_REQUIRE_GL();
    for (const char* filter : {"pcf3", "pcf9"}) {
        GlCase c{"lamp-room",
                 {{"image.width", "480"},
                  {"image.height", "270"},
                  {"shadow_map.resolution", "48"},
                  {"lookup.filter", filter}}};
        c.draw_all();
        const scene::LookupLayers lookup = c.lookup_pass.read();
        const auto depths = read_shader_depths(*shared_context(), *c.map);
        const analysis::LookupRule rule = analysis::lookup_rule(c.job, c.view);
        const analysis::Footprint footprint{rule.traits, rule.edge(), 48};
        std::size_t over_seams = 0;
        for (std::size_t p = 0; p < lookup.maps.pixel_count(); ++p) {
            const scene::LookupSample& sample = lookup.samples[p];
            if (sample.tan_theta == 0) {
                continue;
            }
            int lit = 0;
            bool is_over_seam = false;
            footprint.visit_taps(lookup.at(p), [&](const analysis::Tap& tap) {
                is_over_seam |= tap.texel.map != lookup.maps[p];
                lit += rule.is_lit(sample.receiver_depth, at_texel(depths, tap.texel),
                                   c.view.bias.constant)
                           ? 1
                           : 0;
            });
            over_seams += is_over_seam ? 1U : 0U;
            const auto taps = static_cast<float>(footprint.tap_count());
            ASSERT_EQ(sample.verdict, static_cast<float>(lit) / taps)
                << filter << ", pixel " << p << ", face " << int{lookup.maps[p]} << " at "
                << lookup.texels[p].x << ' ' << lookup.texels[p].y;
        }
        EXPECT_GT(over_seams, 2'000U);
    }
}

} // namespace
} // namespace gnomon::tests
