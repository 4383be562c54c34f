#include "analysis/comparison/comparison.hpp"

#include "analysis/sweep/compare.hpp"
#include "fake_renderers.hpp"
#include "scene/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::PixelClass;
using testing::ElementsAre;

constexpr scene::ImageSize image{4, 2};

scene::SceneFile one_triangle()
{
    scene::SceneBuilder builder;
    const std::vector<scene::Vec3d> vertices{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 1}};
    builder.add("sheet", vertices, triangles);
    builder.count_ignored_primitives(3);
    return {builder.take(), {}};
}

scene::Job job_of_file()
{
    scene::Job job;
    job.scene.file = "models/sheet.obj";
    job.image = image;
    job.camera = scene::CameraSettings{};
    return job;
}

/// Renderers without GL and Embree that record their calls.
struct NotingRenderers : tests::FakeRenderers {
    std::vector<std::string> calls;

    NotingRenderers()
    {
        rasterizer.on_receivers = [this](const scene::View& view) {
            calls.emplace_back("receivers");
            return scene::ReceiverLayers{scene::Image<std::uint32_t>{view.image, 0}};
        };
        rasterizer.on_map = [this] { calls.emplace_back("shadow_map"); };
        rasterizer.on_look_up = [this](const scene::Job&, const scene::View& view) {
            calls.emplace_back("lookup");
            return scene::LookupLayers{
                scene::Image<scene::LookupSample>{view.image, {0, 0, 0, 1.0F}}};
        };
        reference.on_truth = [this](const scene::View& view, const scene::ReceiverLayers&) {
            calls.emplace_back("truth");
            scene::Truth truth;
            truth.pixel_class = scene::Image<PixelClass>{view.image, PixelClass::lit};
            truth.pixel_class(3, 1) = PixelClass::blocked;
            truth.reason = scene::Image<scene::ClassReason>{view.image};
            truth.witness = scene::Image<std::uint32_t>{view.image, scene::no_triangle};
            return truth;
        };
        environment = {"renderer", "version", "embree", "gnomon"};
        rasterizer.bits = 4;
    }
};

TEST(Compare, CallsEachStageOnceAndMeasures)
{
    const scene::SceneFile file = one_triangle();
    NotingRenderers fake;
    const Comparison result = compare(job_of_file(), file, fake.renderers());
    EXPECT_THAT(fake.calls, ElementsAre("receivers", "truth", "shadow_map", "lookup"));
    EXPECT_EQ(result.metrics.pixels.total, 8U);
    EXPECT_EQ(result.metrics.false_lit, 1U);
    EXPECT_EQ(result.metrics.false_lit_rate, 1.0);
    EXPECT_EQ(result.metrics.false_shadow_rate, 0.0);
}

TEST(Compare, DrawsNothingForAJobThatIsRefused)
{
    const scene::SceneFile file = one_triangle();
    NotingRenderers fake;
    scene::Job job = job_of_file();
    job.bias.constant = 1e-40; // not a normal float
    EXPECT_THROW((void)compare(job, file, fake.renderers()), scene::InputError);
    EXPECT_THAT(fake.calls, testing::IsEmpty());
}

TEST(Compare, FailsAsTheRendererDoes)
{
    const scene::SceneFile file = one_triangle();
    NotingRenderers fake;
    fake.rasterizer.on_map = [] { throw scene::EnvironmentError{"no memory for the map"}; };
    EXPECT_THROW((void)compare(job_of_file(), file, fake.renderers()), scene::EnvironmentError);
    fake.rasterizer.on_map = [] { throw scene::InputError{"too large a map"}; };
    EXPECT_THROW((void)compare(job_of_file(), file, fake.renderers()), scene::InputError);
}

TEST(Compare, OfSeveralJobsGivesEachWhatItGivesAlone)
{
    const scene::SceneFile file = one_triangle();
    std::vector<scene::Job> jobs(3, job_of_file());
    jobs[1].image = {3, 5};
    jobs[2].bias.constant = 0.25; // differs from the first only in the bias
    NotingRenderers fake;
    fake.reference.on_truth = [](const scene::View& view, const scene::ReceiverLayers&) {
        scene::Truth truth;
        truth.pixel_class = scene::Image<PixelClass>{view.image, PixelClass::blocked};
        truth.reason = scene::Image<scene::ClassReason>{view.image};
        truth.witness = scene::Image<std::uint32_t>{view.image, 0};
        return truth;
    };
    std::vector<Comparison> found(jobs.size());
    compare_each(jobs, file, fake.renderers(), [&](std::size_t job, Comparison&& comparison) {
        found[job] = std::move(comparison);
    });
    EXPECT_THAT(fake.calls, ElementsAre("receivers", "shadow_map", "lookup", "lookup", "receivers",
                                        "lookup")); // one map for all
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const Comparison alone = compare(jobs[i], file, fake.renderers());
        EXPECT_EQ(found[i].view.bias.constant, alone.view.bias.constant);
        EXPECT_EQ(found[i].receivers.triangle.size(), jobs[i].image);
        EXPECT_EQ(found[i].truth.pixel_class.size(), jobs[i].image);
        EXPECT_EQ(found[i].metrics.false_lit, alone.metrics.false_lit);
        EXPECT_EQ(found[i].metrics.false_lit, jobs[i].image.pixel_count());
    }
}

TEST(Compare, EndsWithWhatTheTakerThrows)
{
    const scene::SceneFile file = one_triangle();
    const std::vector<scene::Job> jobs(2, job_of_file());
    NotingRenderers fake;
    int taken = 0;
    EXPECT_THROW(compare_each(jobs, file, fake.renderers(),
                              [&](std::size_t, Comparison&&) {
                                  ++taken;
                                  throw std::runtime_error{"the disk is full"};
                              }),
                 std::runtime_error);
    EXPECT_EQ(taken, 1);
}

TEST(Compare, CarriesItsInputsAndItsEnvironment)
{
    const scene::SceneFile file = one_triangle();
    NotingRenderers fake;
    const Comparison result = compare(job_of_file(), file, fake.renderers());
    EXPECT_EQ(result.triangles, &file.scene);
    EXPECT_EQ(result.view.image, image);
    EXPECT_EQ(result.scene.name, "sheet.obj");
    EXPECT_EQ(result.scene.triangles, 1U);
    EXPECT_EQ(result.scene.objects, 1U);
    EXPECT_EQ(result.scene.ignored_primitives, 3U);
    EXPECT_EQ(result.scene.hash, scene::content_hash(file.scene));
    EXPECT_EQ(result.truth_method, "exact");
    EXPECT_EQ(result.subpixel_bits, 4);
    EXPECT_EQ(result.environment.gl_renderer, "renderer");
}

TEST(Compare, NamesABuiltinSceneByItsName)
{
    scene::SceneSettings settings;
    settings.builtin = "wall";
    EXPECT_EQ(summarise_scene(settings, one_triangle().scene).name, "wall");
}

TEST(Compare, TimesEachStageByItself)
{
    const scene::SceneFile file = one_triangle();
    NotingRenderers fake;
    constexpr std::chrono::milliseconds pause{20};
    fake.rasterizer.on_map = [&] { std::this_thread::sleep_for(pause); };
    const StageSeconds seconds = compare(job_of_file(), file, fake.renderers()).seconds;
    // sleep_for never returns early. The other stages do almost nothing, but a busy machine may
    // interrupt them, so only the lower limit is certain.
    EXPECT_GE(seconds.shadow_map, std::chrono::duration<double>(pause).count());
    EXPECT_GT(seconds.truth, 0.0);
    EXPECT_GT(seconds.scene, 0.0);
    EXPECT_EQ(seconds.bvh, 0.0);
}

TEST(Compare, PassesTheReceiversToTheTruth)
{
    const scene::SceneFile file = one_triangle();
    NotingRenderers fake;
    fake.rasterizer.on_receivers = [](const scene::View& view) {
        return scene::ReceiverLayers{scene::Image<std::uint32_t>{view.image, 77}};
    };
    std::uint32_t seen = 0;
    fake.reference.on_truth = [&, find_truth = fake.reference.on_truth](
                                  const scene::View& view, const scene::ReceiverLayers& layers) {
        seen = layers.triangle(0, 0);
        return find_truth(view, layers);
    };
    (void)compare(job_of_file(), file, fake.renderers());
    EXPECT_EQ(seen, 77U);
}

TEST(Compare, RejectsLayersThatAreNotOfTheImagesSize)
{
    const scene::SceneFile file = one_triangle();
    NotingRenderers fake;
    fake.rasterizer.on_look_up = [](const scene::Job&, const scene::View&) {
        return scene::LookupLayers{scene::Image<scene::LookupSample>{scene::ImageSize{1, 1}}};
    };
    EXPECT_THROW((void)compare(job_of_file(), file, fake.renderers()), std::invalid_argument);
}

TEST(Compare, RejectsAJobThatHasNoView)
{
    const scene::SceneFile file = one_triangle();
    NotingRenderers fake;
    scene::Job job = job_of_file();
    job.camera->eye = job.camera->target;
    EXPECT_THROW((void)compare(job, file, fake.renderers()), scene::InputError);
}

} // namespace
} // namespace gnomon::analysis
