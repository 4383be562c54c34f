#include "gl_case.hpp"

#include "raster_gl/depth_formats.hpp"
#include "raster_gl/raster_planes.hpp"
#include "scene/depth/depth_codes.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

/// Colour formats as the shader writes them, against the same text compiled as C++.
namespace gnomon::raster_gl {
namespace {

using tests::GlCase;

constexpr auto colour_names = {"r32f", "r16f", "rgba8"};

void expect_codes_of_their_z(const ShadowMap& map, const std::string& where)
{
    const auto codes = read_codes(*tests::shared_context(), map);
    const auto z = read_unquantised_z(*tests::shared_context(), map);
    const auto depths = read_shader_depths(*tests::shared_context(), map);
    for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
        ASSERT_EQ(codes[i], scene::colour_code(map.format, z[i])) << where << " z " << z[i];
        ASSERT_EQ(std::bit_cast<std::uint32_t>(depths[i]),
                  std::bit_cast<std::uint32_t>(scene::colour_value(map.format, codes[i])))
            << where << " z " << z[i];
    }
}

TEST(ColourFormats, AreTheSameInGlslAndInCpp)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"columns", "lamp-room"}) {
        GlCase c{scene};
        for (const char* format : colour_names) {
            for (const char* reversed : {"false", "true"}) {
                c.set({{"shadow_map.depth_format", format},
                       {"shadow_map.resolution", "400"},
                       {"shadow_map.reversed", reversed}});
                c.draw_shadow_map();
                expect_codes_of_their_z(*c.map,
                                        fmt::format("{} {} reversed {}", scene, format, reversed));
            }
        }
    }
}

TEST(ColourFormats, AreTheSameInGlslAndInCppOfDistances)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"lamp-room"};
    for (const char* format : colour_names) {
        c.set({{"shadow_map.depth_format", format},
               {"shadow_map.resolution", "400"},
               {"shadow_map.content", "distance"}});
        c.draw_shadow_map();
        expect_codes_of_their_z(*c.map, format);
    }
}

/// Depths of every size down to below the smallest half.
TEST(ColourFormats, AreTheSameInGlslAndInCppOfSmallDepths)
{
    GNOMON_REQUIRE_GL();
    scene::MeasuredPlaneSettings settings;
    settings.range = {scene::Projection::perspective, 1e-4, 1e4, true,
                      scene::ClipRange::zero_to_one};
    settings.count = 1 << 16;
    const scene::MeasuredPlanes planes = scene::make_measured_planes(settings);
    RasterPlanes raster{*tests::shared_context(), planes};
    for (const char* name : colour_names) {
        const auto format = scene::depth_format_from_name(name).value();
        float smallest = 1;
        for (const auto& sample : raster.measure(format).samples) {
            ASSERT_EQ(sample.texel.code, scene::colour_code(format, sample.shader_depth)) << name;
            smallest = std::min(smallest, sample.shader_depth);
        }
        EXPECT_LT(smallest, 0x1p-25F) << name; // rounds to no half but 0
    }
}

/// What is nearest is decided by depth, whatever its code stands for.
TEST(ColourFormats, HoldTheSurfacesOfTheMapOfFloats)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"yard", "lamp-room"}) {
        for (const char* content : {"depth", "distance"}) {
            if (scene == std::string{"yard"} && content == std::string{"distance"}) {
                continue; // a directional light has none
            }
            const std::vector<scene::Override> keys{{"shadow_map.resolution", "400"},
                                                    {"shadow_map.content", content}};
            GlCase c{scene, keys};
            const auto depths_in = [&](const char* format) {
                auto with_format = keys;
                with_format.push_back({"shadow_map.depth_format", format});
                c.set(with_format);
                c.draw_shadow_map();
                return read_shader_depths(*tests::shared_context(), *c.map);
            };
            const auto floats = depths_in("d32f");
            for (const char* name : colour_names) {
                const auto format = scene::depth_format_from_name(name).value();
                const auto depths = depths_in(name);
                for (std::size_t i = 0; i < depths.pixel_count(); ++i) {
                    ASSERT_EQ(depths[i],
                              scene::colour_value(format, scene::colour_code(format, floats[i])))
                        << scene << " " << content << " " << name << " z " << floats[i];
                }
            }
        }
    }
}

TEST(ColourFormats, AreOneWhereNothingIsAndZeroReversed)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"sphere-plane"};
    for (const char* format : colour_names) {
        for (const auto& [reversed, empty] : {std::pair{"false", 1.0F}, {"true", 0.0F}}) {
            c.set({{"shadow_map.fit", "fixed"}, // beside the scene
                   {"shadow_map.fov_deg", "2"},
                   {"light.target", "[0, 100, 0]"},
                   {"shadow_map.near", "0.1"},
                   {"shadow_map.far", "10"},
                   {"shadow_map.depth_format", format},
                   {"shadow_map.reversed", reversed}});
            c.draw_shadow_map();
            for (const float depth : read_shader_depths(*tests::shared_context(), *c.map)) {
                ASSERT_EQ(depth, empty) << format;
            }
        }
    }
}

} // namespace
} // namespace gnomon::raster_gl
