// Multisampled maps: the samples behind variance maps, and the depths that causes use as exact.

#include "compared.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "methods_job.hpp"
#include "raster_gl/map/multisampled_depth.hpp"
#include "raster_gl/map/prefilter.hpp"
#include "raster_gl/readback.hpp"
#include "reference_rt/light/light_queries.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/pixels/map_texels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

using scene::Vec2d;
using scene::Vec2f;

constexpr int samples = 4;

/// A variance map that averages only the samples of each texel.
scene::Job of_samples(scene::Job job)
{
    job.method.name = "vsm";
    job.method.values["method.kernel_width"] = std::int64_t{1};
    job.method.values["method.samples"] = std::int64_t{samples};
    return job;
}

/// The moments in a variance map of the scene (`scene::maps_image_size`).
scene::Image<Vec2f> moments_of(const scene::Job& job, const scene::SceneFile& file)
{
    const raster_gl::Context& context = *shared_context();
    const scene::View view = resolve_view(job, file.scene, file.defaults);
    const raster_gl::GpuScene gpu{context, file.scene};
    raster_gl::ShadowMapPass map_pass{context};
    raster_gl::MultisampledDepth casters{context};
    raster_gl::PrefilterPass prefilter{context};
    const raster_gl::ShadowMap& map = map_pass.render(gpu, view.maps, job.shadow_map);
    const auto& filtered =
        prefilter.render(map, methods::passes(job), renderers::FilteredContent::of_method,
                         {casters.render(gpu, view.maps, job.shadow_map, samples)});
    const int side = job.shadow_map.resolution_texels;
    return raster_gl::read_texture<Vec2f>(filtered.layer(0), {side, side}, GL_RG, GL_FLOAT);
}

#define GNOMON_REQUIRE_SAMPLES()                                                                   \
    GNOMON_REQUIRE_GL();                                                                           \
    if (shared_context()->facts().max_depth_samples < samples) {                                   \
        GTEST_SKIP() << "no depth textures of " << samples << " samples";                          \
    }

TEST(Samples, LieInTheTexelApart)
{
    GNOMON_REQUIRE_SAMPLES();
    const auto places = raster_gl::MultisampledDepth{*shared_context()}.places(samples);
    ASSERT_EQ(places.size(), 4U);
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (const double at : {places[i].x, places[i].y}) {
            EXPECT_GE(at, 0);
            EXPECT_LT(at, 1);
        }
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NE(places[i], places[j]);
        }
    }
}

/// A plate that covers the texels' columns up to 31 and a share of the next: texels are 1/8 m, and
/// u grows against x.
TEST(Samples, OfATexelThatAnEdgeCrossesAreCoveredWhereTheyLieBeforeIt)
{
    GNOMON_REQUIRE_SAMPLES();
    const auto places = raster_gl::MultisampledDepth{*shared_context()}.places(samples);
    const scene::Job job = of_samples(looking_down({}));
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        SCOPED_TRACE(testing::Message() << "share " << share);
        const auto moments = moments_of(job, plates_over_ground({{-share / 8, 2, -2, 2, 4}}));
        const auto covered =
            std::ranges::count_if(places, [&](const Vec2d& place) { return place.x < share; });
        // Depths are (8 − y − 0.5)/8 under a light 8 m above the ground: 7.5/8 and 3.5/8.
        const double plate = static_cast<double>(covered) / samples;
        const double mean = plate * 3.5 / 8 + (1 - plate) * 7.5 / 8;
        const double squares = plate * 12.25 / 64 + (1 - plate) * 56.25 / 64;
        EXPECT_EQ(double{at_texel(moments, {32, 32, 0}).x}, mean);
        EXPECT_EQ(double{at_texel(moments, {32, 32, 0}).y}, squares);
        EXPECT_EQ(double{at_texel(moments, {31, 32, 0}).x}, 3.5 / 8);
        EXPECT_EQ(double{at_texel(moments, {33, 32, 0}).x}, 7.5 / 8);
    }
}

/// Depths found by rays through a point and, because the driver snaps corners, by rays half a grid
/// step around it.
struct DepthsAround {
    std::vector<float> lowest;
    std::vector<float> highest;
};
DepthsAround depths_around(const renderers::LightQueries& light,
                           const std::vector<scene::Texel>& texels, const Vec2d& place)
{
    const scene::RasterModel model = raster_model();
    const double half_step = std::ldexp(0.5, -model.subpixel_bits);
    DepthsAround found{light.texel_depths(texels, place), {}};
    found.highest = found.lowest;
    if (!model.interpolates_from_snapped) {
        return found;
    }
    for (const double dx : {-half_step, half_step}) {
        for (const double dy : {-half_step, half_step}) {
            const auto depths = light.texel_depths(texels, place + Vec2d{dx, dy});
            for (std::size_t i = 0; i < texels.size(); ++i) {
                found.lowest[i] = std::min(found.lowest[i], depths[i]);
                found.highest[i] = std::max(found.highest[i], depths[i]);
            }
        }
    }
    return found;
}

/// GL rounds vertices to its grid, so that samples next to an edge may be on its other side: few.
TEST(Samples, HaveTheDepthsThatExactRaysThroughTheirPlacesFind)
{
    GNOMON_REQUIRE_SAMPLES();
    for (const char* const builtin : {"sphere-plane", "columns", "sphere-cube"}) {
        SCOPED_TRACE(builtin);
        const scene::Job job =
            of_samples(tests::builtin_job(builtin, {{"shadow_map.resolution", "128"},
                                                    {"shadow_map.depth_format", "d32f"}})
                           .job);
        const scene::SceneFile file = scene::load_scene(job.scene);
        const scene::View view = resolve_view(job, file.scene, file.defaults);
        const reference_rt::ReferenceScene reference{file.scene};
        const scene::Image<std::uint32_t> receivers{view.image, scene::no_triangle};
        const int side = job.shadow_map.resolution_texels;
        const auto light =
            reference_rt::make_light_queries(reference, view, receivers, side, job.shadow_map.cull);
        std::vector<scene::Texel> texels;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                texels.push_back({x, y, 0});
            }
        }
        std::vector<double> lowest(texels.size());
        std::vector<double> highest(texels.size());
        for (const Vec2d& place : raster_gl::MultisampledDepth{*shared_context()}.places(samples)) {
            const DepthsAround depths = depths_around(*light, texels, place);
            for (std::size_t i = 0; i < texels.size(); ++i) {
                lowest[i] += double{depths.lowest[i]} / samples;
                highest[i] += double{depths.highest[i]} / samples;
            }
        }
        const auto centres = light->texel_depths(texels, scene::texel_centre);
        const auto moments = moments_of(job, file);
        std::size_t different = 0;
        std::size_t not_of_centres = 0;
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const double mean{at_texel(moments, texels[i]).x};
            different += mean < lowest[i] - 1e-5 || mean > highest[i] + 1e-5 ? 1U : 0U;
            not_of_centres += std::abs(mean - double{centres[i]}) > 1e-5 ? 1U : 0U;
        }
        EXPECT_LT(different, texels.size() / 200);
        EXPECT_GT(not_of_centres, 10 * different);
        EXPECT_GT(not_of_centres, texels.size() / 100);
    }
}

TEST(Samples, ThatNoDriverHasAreRefused)
{
    const auto job = [](const char* of_texel) {
        return tests::builtin_job("wall", {{"method.name", "vsm"}, {"method.samples", of_texel}})
            .job;
    };
    EXPECT_EQ(methods::traits(job("4")).samples, 4);
    for (const char* const of_texel : {"0", "3", "5", "6", "16"}) {
        EXPECT_THROW((void)job(of_texel), scene::InputError) << of_texel;
    }
}

TEST(Samples, ThatThisDriverLacksAreRefused)
{
    GNOMON_REQUIRE_GL();
    const int too_many = 2 * shared_context()->facts().max_depth_samples;
    raster_gl::MultisampledDepth casters{*shared_context()};
    EXPECT_THROW((void)casters.places(too_many), scene::InputError);
}

} // namespace
} // namespace gnomon::tests
