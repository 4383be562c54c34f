#include "raw_embree.hpp"
#include "reference_rt/points/point_truth.hpp"
#include "reference_rt/rounded/nearest_surface.hpp"
#include "scene/job/file.hpp"
#include "subject.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

/// Compares the exact truth, with shadow segments and the camera's first hits, to one raw occlusion
/// pass over the scored pixels. Each iteration measures both.
namespace gnomon::benchmarks {
namespace {

using reference_rt::ReferenceScene;

const std::vector<scene::Override> full_hd{{"image.width", "1920"}, {"image.height", "1080"}};

/// The fastest run, because disturbances only add time. Processor time of all threads suffers less
/// from other load than wall time.
struct Fastest {
    double seconds = std::numeric_limits<double>::infinity();
    double processor_seconds = std::numeric_limits<double>::infinity();

    /// @return  Wall time [s].
    double add(const std::function<void()>& work)
    {
        const std::clock_t start = std::clock();
        const double run_s = seconds_of(work);
        const auto ticks = static_cast<double>(std::clock() - start);
        seconds = std::min(seconds, run_s);
        processor_seconds = std::min(processor_seconds, ticks / CLOCKS_PER_SEC);
        return run_s;
    }
};

/// The time to build only the hierarchy of the exact truth [s].
double exact_bvh_s(const scene::TriangleScene& scene)
{
    return seconds_of([&] {
        const ReferenceScene built{scene};
        const void* triangles = &built.triangles();
        benchmark::DoNotOptimize(triangles);
    });
}

/// Compares the truth of points on triangles to that of the scored pixels that show them. The
/// pixels' truth also includes the camera's first hits.
void points_against_pixels(benchmark::State& state, const scene::Job& job)
{
    const Subject subject{job};
    const scene::TriangleScene& scene = subject.file.scene;
    const scene::View view = resolve_view(job, scene, subject.file.defaults);
    const auto drawn = subject.gl->draw_receivers(view);
    const auto receivers = drawn->layers().triangle;
    const renderers::RasterFacts raster = drawn->raster_facts();
    scene::Truth truth = compute_truth(*subject.reference, view, receivers, raster);
    const auto seen = reference_rt::receiver_points(scene, view, receivers);
    std::vector<std::uint32_t> triangles;
    std::vector<scene::Vec2d> places;
    for (std::size_t pixel = 0; pixel < truth.pixel_class.pixel_count(); ++pixel) {
        if (scene::is_scored(truth.pixel_class[pixel])) {
            triangles.push_back(receivers[pixel]);
            places.push_back(reference_rt::nearest_place(
                scene::Vec3d{seen[pixel]}, reference_rt::corners_of(scene, receivers[pixel])));
        }
    }
    Fastest pixels;
    Fastest points;
    scene::PointTruth of_points;
    for (auto _ : state) {
        pixels.add([&] { truth = compute_truth(*subject.reference, view, receivers, raster); });
        state.SetIterationTime(points.add([&] {
            of_points = reference_rt::find_point_truth(*subject.reference, view.light,
                                                       scene::SurfacePoints{triangles, places});
        }));
    }
    state.counters["ratio"] = points.seconds / pixels.seconds;
    state.counters["processor_ratio"] = points.processor_seconds / pixels.processor_seconds;
    state.counters["points"] = static_cast<double>(triangles.size());
    state.counters["points_ms"] = 1000 * points.seconds;
    state.counters["exact_signs"] = static_cast<double>(of_points.signs.exact);
}

void truth_against_raw_pass(benchmark::State& state, const scene::Job& job)
{
    const Subject subject{job};
    const scene::TriangleScene& scene = subject.file.scene;
    const scene::View view = resolve_view(job, scene, subject.file.defaults);
    const auto drawn = subject.gl->draw_receivers(view);
    const auto receivers = drawn->layers().triangle;
    renderers::RasterFacts raster{subject.context.facts().subpixel_bits, {}};
    const double clip_positions_s = seconds_of([&] { raster = drawn->raster_facts(); });
    scene::Truth truth = compute_truth(*subject.reference, view, receivers, raster);
    std::unique_ptr<RawEmbreePass> raw;
    const double raw_setup_s = seconds_of([&] {
        raw = std::make_unique<RawEmbreePass>(
            scene, view, truth, reference_rt::receiver_points(scene, view, receivers));
    });
    Fastest exact;
    Fastest floor;
    for (auto _ : state) {
        floor.add([&] { benchmark::DoNotOptimize(raw->run()); });
        state.SetIterationTime(
            exact.add([&] { truth = compute_truth(*subject.reference, view, receivers, raster); }));
    }
    state.counters["ratio"] = exact.seconds / floor.seconds;
    state.counters["processor_ratio"] = exact.processor_seconds / floor.processor_seconds;
    state.counters["truth_ms"] = 1000 * exact.seconds;
    state.counters["raw_ms"] = 1000 * floor.seconds;
    state.counters["rays"] = static_cast<double>(raw->ray_count());
    state.counters["exact_signs"] = static_cast<double>(truth.signs.exact);
    state.counters["bvh_ms"] = 1000 * exact_bvh_s(scene);
    state.counters["raw_setup_ms"] = 1000 * raw_setup_s;
    state.counters["clip_positions_ms"] = 1000 * clip_positions_s;
}

void add(const std::string& name, const scene::Job& job)
{
    benchmark::RegisterBenchmark(
        ("truth/" + name + "/1080p").c_str(),
        [job](benchmark::State& state) { truth_against_raw_pass(state, job); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->MinTime(3.0);
    benchmark::RegisterBenchmark(
        ("points/" + name + "/1080p").c_str(),
        [job](benchmark::State& state) { points_against_pixels(state, job); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->MinTime(3.0);
}

/// Adds the bunny on a ground, or a benchmark that reports its absence.
void add_bunny()
{
    const char* const folder = std::getenv("GNOMON_SHARED_SCENES");
    const auto file = std::filesystem::path{folder == nullptr ? "" : folder} / "bunny.obj";
    if (!std::filesystem::exists(file)) {
        benchmark::RegisterBenchmark("truth/bunny/1080p", [](benchmark::State& state) {
            state.SkipWithError("skipped: bunny.obj is not in the folder GNOMON_SHARED_SCENES");
        });
        return;
    }
    auto keys = full_hd;
    keys.push_back({"scene.ground", "true"});
    add("bunny", scene::read_job(file, keys).job);
}

} // namespace
} // namespace gnomon::benchmarks

int main(int argc, char** argv)
{
    namespace benchmarks = gnomon::benchmarks;
    for (const char* const builtin : {"sphere-field", "columns"}) {
        benchmarks::add(builtin, gnomon::scene::builtin_job(builtin, benchmarks::full_hd).job);
    }
    benchmarks::add_bunny();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
