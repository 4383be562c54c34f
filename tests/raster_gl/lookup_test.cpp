#include "gl_case.hpp"

#include "lane.hpp"
#include "methods/depth/depth_map.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

/// Repeats the lookup in C++, from GL's interpolated light clip coordinates and stored map: nearest
/// and pcf must agree on every pixel.
namespace gnomon::raster_gl {
namespace {

using tests::GlCase;

struct ByHand {
    float r = 0;
    scene::Vec2f texel{};
    float d = 0;
    float verdict = 0;
};

class HandLookup {
public:
    HandLookup(const GlCase& c, const scene::Image<float>& map)
        : c_{c},
          map_{map},
          resolution_{c.map->resolution_texels},
          half_{methods::filter_traits(c.job.lookup.filter).width_texels / 2}
    {
    }

    [[nodiscard]] ByHand operator()(const scene::Vec4f& clip, float tan_theta) const
    {
        ByHand result;
        const float depth = clip.z / clip.w;
        result.r = c_.map->reversed ? depth : depth * 0.5F + 0.5F;
        const auto resolution = static_cast<float>(resolution_);
        result.texel = {(clip.x / clip.w * 0.5F + 0.5F) * resolution,
                        (clip.y / clip.w * 0.5F + 0.5F) * resolution};
        finish(result, tan_theta, clip.w);
        return result;
    }

    /// Computes the verdict from r and texel, so that drivers with a non-IEEE division can be
    /// checked from the values that they return.
    void finish(ByHand& result, float tan_theta, float w) const
    {
        const scene::Bias& bias = c_.view.bias;
        const float b = bias.constant + bias.slope * tan_theta;
        const bool clamp = c_.job.lookup.outside == scene::Outside::clamp;
        const float border = c_.job.lookup.outside == scene::Outside::shadowed ? 0.0F : 1.0F;
        const bool beyond_far = c_.map->reversed ? !(result.r >= 0) : !(result.r <= 1);
        result.d = std::numeric_limits<float>::quiet_NaN();
        if (clamp) {
            result.r = std::min(std::max(result.r, 0.0F), 1.0F);
        } else if (beyond_far || !(w > 0)) {
            result.verdict = border;
            return;
        }
        float lit = 0;
        for (int y = -half_; y <= half_; ++y) {
            for (int x = -half_; x <= half_; ++x) {
                const float d = fetch(std::floor(result.texel.x) + static_cast<float>(x),
                                      std::floor(result.texel.y) + static_cast<float>(y), clamp);
                if (x == 0 && y == 0) {
                    result.d = d;
                }
                const bool tap_lit = c_.map->reversed ? result.r + b >= d : result.r - b <= d;
                lit += std::isnan(d) ? border : (tap_lit ? 1.0F : 0.0F);
            }
        }
        const int width = 2 * half_ + 1;
        result.verdict = lit / static_cast<float>(width * width);
    }

private:
    [[nodiscard]] float fetch(float x, float y, bool clamp) const
    {
        const auto last = static_cast<float>(resolution_ - 1);
        if (clamp) {
            x = std::min(std::max(x, 0.0F), last);
            y = std::min(std::max(y, 0.0F), last);
        } else if (!(x >= 0 && y >= 0 && x <= last && y <= last)) {
            return std::numeric_limits<float>::quiet_NaN();
        }
        // Images have their origin at the top left, texel coordinates at the lower left.
        return map_(static_cast<int>(x), resolution_ - 1 - static_cast<int>(y));
    }

    const GlCase& c_;
    const scene::Image<float>& map_;
    int resolution_;
    int half_;
};

bool same(float a, float b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

/// Compares every pixel; returns how many receivers there were.
std::size_t expect_agreement(GlCase& c, const std::string& label)
{
    const raster_gl::Context& context = *tests::shared_context();
    const auto triangles = read_triangles(context, *c.receivers);
    const auto clip = read_light_clip(context, *c.receivers);
    const auto map = read_shader_depths(context, *c.map);
    const auto samples = c.lookup_pass.read().samples;
    const auto texels = c.lookup_pass.read().texels;
    const HandLookup by_hand{c, map};
    const bool ieee = tests::shader_arithmetic_is_ieee();
    std::size_t receivers = 0;
    std::size_t differences = 0;
    for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
        if (triangles[i] == scene::no_triangle) {
            continue;
        }
        ++receivers;
        const scene::LookupSample& gl = samples[i];
        ByHand hand = by_hand(clip[i], gl.tan_theta);
        if (!ieee) { // division may err by 2.5 ulp; later steps must agree
            EXPECT_NEAR(hand.r, gl.receiver_depth, 8 * 0x1p-24);
            hand.r = gl.receiver_depth;
            hand.texel = texels[i];
            by_hand.finish(hand, gl.tan_theta, clip[i].w);
        }
        const bool agree = same(hand.r, gl.receiver_depth) && hand.texel == texels[i] &&
                           same(hand.d, gl.map_depth) && hand.verdict == gl.verdict;
        differences += agree ? 0 : 1;
        if (!agree && differences == 1) {
            ADD_FAILURE() << fmt::format("{}: pixel {}: by hand r {} d {} verdict {}, GL r {} d {} "
                                         "verdict {}",
                                         label, i, hand.r, hand.d, hand.verdict, gl.receiver_depth,
                                         gl.map_depth, gl.verdict);
        }
    }
    EXPECT_EQ(differences, 0U) << label;
    return receivers;
}

const std::vector<scene::Override> base{
    {"image.width", "480"}, {"image.height", "270"}, {"shadow_map.resolution", "300"}};

std::vector<scene::Override> with(std::vector<scene::Override> keys)
{
    keys.insert(keys.begin(), base.begin(), base.end());
    return keys;
}

TEST(Lookup, EqualsArithmeticByHandForEveryFilterBorderAndFormat)
{
    GNOMON_REQUIRE_GL();
    const bool is_full = tests::runs_full_tests();
    const std::vector<scene::Override> size{{"image.width", is_full ? "480" : "240"},
                                            {"image.height", is_full ? "270" : "135"},
                                            {"shadow_map.resolution", "300"}};
    int number = 0;
    for (const char* scene : {"sphere-plane", "yard"}) { // a spot and a directional light
        GlCase c{scene, size};
        for (const char* filter : {"nearest", "pcf3", "pcf5", "pcf7", "pcf9"}) {
            for (const char* outside : {"lit", "shadowed", "clamp"}) {
                for (const char* format : {"d16", "d24", "d32f", "u11", "r16f", "rgba8"}) {
                    for (const char* reversed : {"false", "true"}) {
                        // The usual lane tries every fifth: each pair of filter, border mode and
                        // format.
                        if (!is_full && number++ % 5 != 0) {
                            continue;
                        }
                        std::vector<scene::Override> keys{
                            {"lookup.filter", filter},           {"lookup.outside", outside},
                            {"shadow_map.depth_format", format}, {"shadow_map.reversed", reversed},
                            {"bias.constant", "0.0007"},         {"bias.slope", "0.0003"}};
                        keys.insert(keys.begin(), size.begin(), size.end());
                        c.set(keys);
                        c.draw_all();
                        const auto label = fmt::format("{} {} {} {} reversed {}", scene, filter,
                                                       outside, format, reversed);
                        EXPECT_GT(expect_agreement(c, label), is_full ? 20000U : 5000U) << label;
                    }
                }
            }
        }
    }
}

/// A map that covers only some of the receivers, sideways and in depth.
std::vector<scene::Override> small_map(const char* outside)
{
    return with({{"shadow_map.fit", "fixed"},
                 {"shadow_map.half_extent", "1.5"},
                 {"shadow_map.far", "0.5"},
                 {"shadow_map.near", "-6"},
                 {"light.type", "directional"},
                 {"light.direction", "[-0.4, -1, -0.3]"},
                 {"lookup.filter", "pcf3"},
                 {"lookup.outside", outside}});
}

TEST(Lookup, AnswersTheBorderModeBeyondTheMap)
{
    GNOMON_REQUIRE_GL();
    for (const char* outside : {"lit", "shadowed", "clamp"}) {
        GlCase c{"wall", small_map(outside)};
        c.draw_all();
        EXPECT_GT(expect_agreement(c, outside), 20000U);
        int decided_by_border = 0;
        for (const scene::LookupSample& sample : c.lookup_pass.read().samples) {
            decided_by_border += std::isnan(sample.map_depth) ? 1 : 0;
        }
        EXPECT_EQ(decided_by_border > 0, std::string{outside} != "clamp") << outside;
    }
}

TEST(Lookup, TakesTanThetaFromTheGeometricNormal)
{
    GNOMON_REQUIRE_GL();
    for (const char* angle : {"0", "45", "80"}) {
        GlCase c{"tilted-plane", with({{"scene.tilted-plane.angle_deg", angle}})};
        c.draw_all();
        const double expected = std::tan(std::stod(angle) * M_PI / 180);
        for (const scene::LookupSample& sample : c.lookup_pass.read().samples) {
            // The corners' heights are rounded to float32 and the normal's length and components
            // too: a few times 2^-24, amplified by d tan/dθ = 1 + tan².
            ASSERT_NEAR(sample.tan_theta, expected, 1e-6 * (1 + expected * expected)) << angle;
        }
    }
}

TEST(Lookup, TakesEachPixelsOwnNormal)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"sphere-plane", "columns"}) { // a spot and a directional light
        GlCase c{scene, base};
        c.draw_all();
        const auto triangles = read_triangles(*tests::shared_context(), *c.receivers);
        const auto positions = read_world_positions(*tests::shared_context(), *c.receivers);
        const auto samples = c.lookup_pass.read().samples;
        for (std::size_t i = 0; i < triangles.pixel_count(); ++i) {
            if (triangles[i] == scene::no_triangle) {
                ASSERT_EQ(samples[i].receiver_depth, 0.0F) << "background is left alone";
                continue;
            }
            const auto corners = c.file.scene.corners(triangles[i]);
            const scene::Vec3d a{corners[0]};
            const scene::Vec3d n =
                glm::cross(scene::Vec3d{corners[1]} - a, scene::Vec3d{corners[2]} - a);
            const bool spot = c.view.light.type == scene::LightType::spot;
            const scene::Vec3d l =
                spot ? c.view.light.position - scene::Vec3d{positions[i]} : -c.view.light.direction;
            const double expected = glm::length(glm::cross(n, l)) / std::abs(glm::dot(n, l));
            // Unit vectors rounded to float32: an angle off by a few times 2^-24, amplified by
            // d tan/dθ = 1 + tan²; grazing angles are left out.
            if (expected < 100) {
                ASSERT_NEAR(samples[i].tan_theta, expected, 2e-6 * (1 + expected * expected))
                    << scene << " pixel " << i;
            }
        }
    }
}

TEST(Lookup, MovesBySoManyTexelWidthsAlongTheNormal)
{
    GNOMON_REQUIRE_GL();
    constexpr double offset_texels = 3;
    GlCase c{"tilted-plane", base};
    c.draw_all();
    const auto plain = c.lookup_pass.read().samples;
    c.set(with({{"bias.normal_texels", std::to_string(offset_texels)}}));
    c.draw_all();
    const auto moved = c.lookup_pass.read().samples;
    const scene::LightFrustum& f = c.view.first_map();
    // A plane at 45°: the normal's component along the light is cos 45°, towards the light.
    const double expected = offset_texels * f.texel_width_m(1, c.map->resolution_texels) *
                            std::cos(M_PI / 4) / f.range_m();
    for (std::size_t i = 0; i < plain.pixel_count(); ++i) {
        // Both depths are below 1 and rounded a few times at 2^-24.
        ASSERT_NEAR(plain[i].receiver_depth - moved[i].receiver_depth, expected, 1e-6);
    }
}

TEST(Lookup, RefusesReceiversOfAnotherSize)
{
    GNOMON_REQUIRE_GL();
    GlCase c{"tilted-plane", base};
    c.draw_all();
    c.view.image = {64, 64};
    EXPECT_THROW(c.look_up(), std::invalid_argument);
}

} // namespace
} // namespace gnomon::raster_gl
