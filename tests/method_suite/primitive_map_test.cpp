// Maps of triangle indices: the textbook's idea that failed, and how.

#include "compared.hpp"
#include "method_case.hpp"
#include "renderers/light_queries.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Label;
using scene::PixelClass;
using scene::Vec2d;
using scene::Vec3d;

const std::vector<scene::Override> ids{{"method.name", "primitive_id"},
                                       {"image.width", "320"},
                                       {"image.height", "180"},
                                       {"shadow_map.resolution", "256"}};

/// The position of a world point in front of the light, in texels from the map's lower left.
Vec2d in_texels(const scene::LightFrustum& map, const Vec3d& point, int resolution)
{
    const scene::Mat4d matrix{map.light_clip_from_world};
    const scene::Vec4d clip = matrix * scene::Vec4d{point, 1.0};
    return {(clip.x / clip.w * 0.5 + 0.5) * resolution, (clip.y / clip.w * 0.5 + 0.5) * resolution};
}

double distance_to_segment(const Vec2d& p, const Vec2d& a, const Vec2d& b)
{
    const Vec2d along = b - a;
    const double square = along.x * along.x + along.y * along.y;
    const double t =
        square > 0 ? std::clamp(((p.x - a.x) * along.x + (p.y - a.y) * along.y) / square, 0.0, 1.0)
                   : 0;
    return std::hypot(p.x - a.x - t * along.x, p.y - a.y - t * along.y);
}

/// Distance from a map point to the nearest edge of a triangle [texels].
double distance_to_edges(const analysis::Comparison& result, std::uint32_t triangle,
                         const Vec2d& place)
{
    std::array<Vec2d, 3> corners;
    std::ranges::transform(result.triangles->corners(triangle), corners.begin(),
                           [&](const scene::Vec3f& corner) {
                               return in_texels(result.view.first_map(), Vec3d{corner},
                                                result.job.shadow_map.resolution_texels);
                           });
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        nearest = std::min(nearest, distance_to_segment(place, corners[i], corners[(i + 1) % 3]));
    }
    return nearest;
}

/// A false shadow's position in the map, and the exact triangle seen through its texel.
struct FalseShadow {
    std::size_t pixel = 0;
    Vec2d place; ///< in the map [texels]
    renderers::TexelHit seen;
};

std::vector<FalseShadow> false_shadows(const Compared& scene, const analysis::Comparison& result)
{
    std::vector<FalseShadow> found;
    std::vector<scene::Texel> texels;
    for (std::size_t i = 0; i < result.lookup.samples.pixel_count(); ++i) {
        if (result.truth.pixel_class[i] == PixelClass::lit &&
            !scene::is_lit(result.lookup.samples[i].verdict)) {
            const Vec2d place{result.lookup.texels[i]};
            found.push_back({i, place, {}});
            texels.push_back({static_cast<int>(place.x), static_cast<int>(place.y), 0});
        }
    }
    const auto light =
        scene.renderers().reference.make_light_queries(result.job, result.view, result.receivers);
    const auto hits = light->first_hits(texels, renderers::HitDetail::placed);
    for (std::size_t i = 0; i < found.size(); ++i) {
        found[i].seen = hits[i];
    }
    return found;
}

/// The texel's centre is at most half a texel's diagonal from the receiver and shows another
/// triangle. Between both lies an edge of the receiver's triangle, or of one that covers only the
/// centre. Positions are float32 of up to 256 texels: 2^-14 of a texel covers their roundings.
void expect_false_shadows_at_edges(const Compared& scene, const analysis::Comparison& result)
{
    const double reach = std::sqrt(0.5) + 0x1p-14;
    std::size_t at_own_edges = 0;
    for (const FalseShadow& shadow : false_shadows(scene, result)) {
        const std::uint32_t own = result.receivers.triangle[shadow.pixel];
        const double to_own = distance_to_edges(result, own, shadow.place);
        const double to_seen = shadow.seen.triangle == scene::no_triangle
                                   ? std::numeric_limits<double>::infinity()
                                   : distance_to_edges(result, shadow.seen.triangle, shadow.place);
        at_own_edges += to_own <= reach ? 1U : 0U;
        ASSERT_LE(std::min(to_own, to_seen), reach) << "pixel " << shadow.pixel;
    }
    EXPECT_GT(at_own_edges, 0U);
}

TEST(PrimitiveMap, ShadowsFalselyAtEdgesAlone)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin :
         {"sphere-cube", "sphere-plane", "terrain", "columns", "tilted-plane"}) {
        SCOPED_TRACE(builtin);
        const scene::Job job = job_of_builtin(builtin, ids);
        const Compared scene{job};
        const auto result = scene(job);
        expect_false_shadows_at_edges(scene, result);
        const auto& counts = result.diagnosis->causes.counts;
        // Without bias and kernel, the only causes are texels and rounding at edges.
        EXPECT_EQ(counts.of(Cause::bias) + counts.of(Cause::filter), 0U);
        EXPECT_EQ(counts.of(Label::peter_panning) + counts.of(Label::bleed), 0U);
    }
}

std::uint64_t of_label(const analysis::Comparison& result, Label label)
{
    return result.diagnosis->causes.counts.of(label);
}

TEST(PrimitiveMap, HasTheLessonsFailureAsAcne)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job = job_of_builtin("terrain", ids);
    const auto result = Compared{job}(job);
    EXPECT_GT(of_label(result, Label::acne), result.metrics.false_shadow / 2)
        << "the edge that a surface's own triangles share";
    EXPECT_GT(result.metrics.false_shadow, result.metrics.pixels.of(PixelClass::lit) / 10);
}

TEST(PrimitiveMap, LightsASurfaceOfOneTriangleAllOver)
{
    GNOMON_REQUIRE_GL();
    scene::SceneBuilder builder;
    const std::array<Vec3d, 3> corners{Vec3d{-40, 0, -40}, Vec3d{0, 0, 60}, Vec3d{40, 0, -40}};
    const std::array<std::array<std::uint32_t, 3>, 1> triangles{{{0, 1, 2}}};
    builder.add("ground", corners, triangles);
    scene::SceneFile file{builder.take(), {}};
    scene::Job job = job_of_builtin("wall", ids);
    job.camera = scene::CameraSettings{.eye = {0, 4, 4}, .target = {0, 0, 0}};
    job.light = scene::LightSettings{};
    job.light->type = scene::LightType::spot;
    job.light->position = Vec3d{2, 5, 1};
    job.light->target = Vec3d{0, 0, 0};
    job.light->cone_deg = 70;
    job.shadow_map.frustum = {};
    const auto result = Compared{std::move(file)}(job);
    EXPECT_GT(result.metrics.pixels.of(PixelClass::lit), 10'000U);
    EXPECT_EQ(result.metrics.false_shadow, 0U);
}

TEST(PrimitiveMap, FailsLessTheFinerItIs)
{
    GNOMON_REQUIRE_GL();
    const Compared scene{job_of_builtin("columns", ids)};
    std::uint64_t before = std::numeric_limits<std::uint64_t>::max();
    for (const char* const resolution : {"256", "512", "1024", "2048"}) {
        const auto result =
            scene(job_of_builtin("columns", with(ids, {{"shadow_map.resolution", resolution}})));
        EXPECT_LT(result.metrics.false_shadow, before) << resolution;
        before = result.metrics.false_shadow;
    }
    EXPECT_GT(before, 0U) << "edges stay edges";
}

TEST(PrimitiveMap, CoversNoReceiverThatNoMapShows)
{
    GNOMON_REQUIRE_GL();
    const auto counts = [](const std::vector<scene::Override>& keys) {
        const scene::Job job = job_of_builtin("sphere-cube", with(ids, keys));
        const auto result = Compared{job}(job);
        EXPECT_GT(result.metrics.false_shadow, 1000U);
        return result.diagnosis->causes.counts;
    };
    // Both meshes are closed, so the light sees only front faces.
    const auto culled = counts({{"shadow_map.cull", "front"}});
    EXPECT_EQ(culled.of(Cause::resolution), 0U);
    EXPECT_EQ(culled.of(Label::edge) + culled.of(Label::acne), 0U);
    const auto without_cube = counts({{"scene.no_cast", "[\"cube\"]"}});
    EXPECT_GT(without_cube.of(Cause::coverage), 1000U);
    EXPECT_EQ(without_cube.of(Cause::coverage), without_cube.of(Label::overshadow));
}

TEST(PrimitiveMap, SeesTheReceiverInEveryLayout)
{
    GNOMON_REQUIRE_GL();
    const auto false_shadow = [](const std::string& builtin,
                                 const std::vector<scene::Override>& keys) {
        const scene::Job job = job_of_builtin(builtin, with(ids, keys));
        const auto result = Compared{job}(job);
        EXPECT_EQ(result.metrics.pixels.of(scene::ClassReason::mismatch), 0U);
        return static_cast<double>(result.metrics.false_shadow) /
               static_cast<double>(result.metrics.pixels.of(PixelClass::lit));
    };
    // With indices of another map, or beside the texel, nearly everything is in shadow.
    EXPECT_LT(false_shadow("columns", {{"shadow_map.layout", "cascades"}}), 0.4);
    EXPECT_LT(false_shadow("columns", {{"shadow_map.reversed", "true"}}), 0.4);
    EXPECT_LT(false_shadow("columns", {{"shadow_map.depth_format", "r32f"}}), 0.4);
    EXPECT_LT(false_shadow("room", {{"light.type", "point"}, {"light.position", "[0, 2, 0]"}}),
              0.4);
}

} // namespace
} // namespace gnomon::tests
