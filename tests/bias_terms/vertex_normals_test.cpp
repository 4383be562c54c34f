#include "analysis/bias/bias_verification.hpp"
#include "compared.hpp"
#include "gl_case.hpp"
#include "methods/job_method.hpp"
#include "methods_job.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

/// Lookups offset along vertex normals.
namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::Comparison;
using OffsetKeys = std::vector<scene::Override>;

OffsetKeys beside(OffsetKeys keys, const OffsetKeys& more)
{
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

scene::Job offset_job(const char* builtin, const OffsetKeys& keys)
{
    return tests::builtin_job(builtin, beside({{"image.width", "160"},
                                               {"image.height", "90"},
                                               {"shadow_map.resolution", "128"},
                                               {"shadow_map.depth_format", "d32f"},
                                               {"bias.constant", "0"}},
                                              keys))
        .job;
}

OffsetKeys along_vertices(const OffsetKeys& keys)
{
    return beside(keys, {{"bias.normal_from", "vertices"}});
}

TEST(OffsetAlongVertexNormals, IsOnFlatFacesThatAlongTheGeometricOnes)
{
    GNOMON_REQUIRE_GL();
    const OffsetKeys keys{{"bias.normal_texels", "1.5"}, {"bias.normal_m", "0.01"}};
    const Compared compared{offset_job("wall", along_vertices(keys))};
    const Comparison along = compared.without_diagnosis(offset_job("wall", along_vertices(keys)));
    const Comparison geometric = compared.without_diagnosis(offset_job("wall", keys));
    std::size_t receivers = 0;
    for (std::size_t i = 0; i < along.lookup.samples.pixel_count(); ++i) {
        if (along.receivers.triangle[i] != scene::no_triangle) {
            ++receivers;
            // Normals round differently, by 2^-24 of a length of two texels.
            ASSERT_LE(glm::length(along.lookup.texels[i] - geometric.lookup.texels[i]), 1e-3F);
        }
    }
    EXPECT_GT(receivers, 1000U);
}

/// The expected lookup position of P, by the double-precision matrix.
scene::Vec2d moved_texel(const Comparison& comparison, std::size_t pixel, const scene::Vec3d& point)
{
    const scene::LightFrustum& map = comparison.view.first_map();
    const scene::Vec3d normal =
        scene::vertex_normal_at(*comparison.triangles, comparison.receivers.triangle[pixel], point);
    const auto corners = comparison.triangles->corners(comparison.receivers.triangle[pixel]);
    const scene::Vec3d a{corners[0]};
    const scene::Vec3d geometric =
        glm::cross(scene::Vec3d{corners[1]} - a, scene::Vec3d{corners[2]} - a);
    const double side =
        glm::dot(geometric, comparison.view.light.position - point) < 0 ? -1.0 : 1.0;
    const double length_m =
        methods::normal_offset_m(comparison.job, comparison.view, 0, map.light_distance_m(point))
            .value();
    const scene::Vec4d clip = scene::Mat4d{map.light_clip_from_world} *
                              scene::Vec4d{point + side * length_m * normal, 1.0};
    return (scene::Vec2d{clip} / clip.w * 0.5 + 0.5) *
           double(comparison.job.shadow_map.resolution_texels);
}

// On a sphere, under a spot. Positions and normals are interpolated in float32. The normal errs by
// its change over 1/256 px: some thousandths of an offset of two texels.
TEST(OffsetAlongVertexNormals, LooksUpThePointThatLiesAlongTheInterpolatedOne)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job =
        offset_job("sphere-plane", along_vertices({{"bias.normal_texels", "2"},
                                                   {"bias.normal_m", "0.01"},
                                                   {"lookup.position", "pixel"}}));
    const Compared compared{job};
    const Comparison comparison = compared.without_diagnosis(job);
    ASSERT_FALSE(comparison.triangles->attributes.empty());
    const scene::Camera& camera = comparison.view.camera;
    std::size_t tried = 0;
    for (int y = 0; y < comparison.view.image.height_px; ++y) {
        for (int x = 0; x < comparison.view.image.width_px; ++x) {
            const std::uint32_t triangle = comparison.receivers.triangle(x, y);
            if (triangle == scene::no_triangle) {
                continue;
            }
            const scene::Ray ray = scene::pixel_ray(camera, comparison.view.image, x, y);
            const auto corners = comparison.triangles->corners(triangle);
            const scene::Vec3d a{corners[0]};
            const scene::Vec3d n =
                glm::cross(scene::Vec3d{corners[1]} - a, scene::Vec3d{corners[2]} - a);
            const double t = glm::dot(n, a - ray.origin) / glm::dot(n, ray.direction);
            const auto row = static_cast<std::size_t>(y);
            const std::size_t pixel =
                row * static_cast<std::size_t>(comparison.view.image.width_px) +
                static_cast<std::size_t>(x);
            const scene::Vec2d expected =
                moved_texel(comparison, pixel, ray.origin + t * ray.direction);
            const scene::Vec2d found{comparison.lookup.texels[pixel]};
            ASSERT_LE(glm::length(found - expected), 0.02) << "pixel " << x << ", " << y;
            ++tried;
        }
    }
    EXPECT_GT(tried, 5000U);
}

TEST(OffsetAlongVertexNormals, DiffersOnASphere)
{
    GNOMON_REQUIRE_GL();
    const OffsetKeys keys{{"bias.normal_texels", "2"}};
    const Compared compared{offset_job("sphere-cube", along_vertices(keys))};
    const Comparison along =
        compared.without_diagnosis(offset_job("sphere-cube", along_vertices(keys)));
    const Comparison geometric = compared.without_diagnosis(offset_job("sphere-cube", keys));
    std::size_t different = 0;
    for (std::size_t i = 0; i < along.lookup.samples.pixel_count(); ++i) {
        different += along.lookup.texels[i] != geometric.lookup.texels[i] ? 1U : 0U;
    }
    EXPECT_GT(different, 200U);
}

TEST(OffsetAlongVertexNormals, LeavesCurvesAndCausesExact)
{
    GNOMON_REQUIRE_GL();
    for (const char* const builtin : {"sphere-cube", "sphere-plane"}) {
        const Compared compared{offset_job(builtin, along_vertices({{"bias.normal_texels", "1"}}))};
        for (const char* const filter : {"nearest", "hardware", "pcf3"}) {
            SCOPED_TRACE(fmt::format("{} {}", builtin, filter));
            const scene::Job job = offset_job(
                builtin,
                along_vertices({{"bias.normal_texels", "1.5"}, {"lookup.filter", filter}}));
            const Comparison comparison = compared(job);
            ASSERT_TRUE(comparison.diagnosis && comparison.diagnosis->biases);
            const auto verification = analysis::verify_comparison(comparison, compared.renderers());
            ASSERT_TRUE(verification);
            EXPECT_GE(verification->reruns.size(), 4U);
            for (const auto& rerun : verification->reruns) {
                EXPECT_EQ(rerun.differences, 0U) << "bias " << rerun.bias;
            }
            std::uint64_t explained = 0;
            for (const Cause cause : {Cause::bias, Cause::precision, Cause::filter,
                                      Cause::resolution, Cause::coverage}) {
                explained += comparison.diagnosis->causes.counts.of(cause);
            }
            EXPECT_EQ(explained, comparison.metrics.false_shadow + comparison.metrics.false_lit);
        }
    }
}

TEST(OffsetAlongVertexNormals, NeedsASceneThatHasThem)
{
    GNOMON_REQUIRE_GL();
    const scene::Job job = offset_job("sphere-cube", along_vertices({{"bias.normal_texels", "1"}}));
    const Compared without{scene::load_scene(job.scene)};
    EXPECT_THROW((void)without.without_diagnosis(job), std::invalid_argument);
    EXPECT_EQ(methods::vertex_normals(job), scene::VertexNormals::kept);
    EXPECT_EQ(methods::vertex_normals(offset_job("sphere-cube", {{"bias.normal_texels", "1"}})),
              scene::VertexNormals::dropped);
}

} // namespace
} // namespace gnomon::tests
