#include "analysis/bias/bias_curve.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "analysis/sweep/compare.hpp"
#include "api/loaded_scene.hpp"
#include "raster_gl/context.hpp"
#include "reference_rt/truth.hpp"
#include "scene/job/file.hpp"
#include "scene/load/load_scene.hpp"
#include "seconds_of.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

/// Compares the bias curve of all pixels, with critical biases and best interval, to one
/// `std::sort` of the critical biases. Each iteration measures both.
namespace gnomon::benchmarks {
namespace {

/// The lookup and the classes of a built-in scene.
struct Subject {
    scene::LookupLayers lookup;
    scene::Image<scene::PixelClass> classes;
    analysis::LookupRule rule;

    Subject(const std::string& builtin, const char* slope)
    {
        const scene::Job job = scene::builtin_job(builtin, {{"image.width", "1920"},
                                                            {"image.height", "1080"},
                                                            {"shadow_map.resolution", "2048"},
                                                            {"lookup.filter", "nearest"},
                                                            {"bias.slope", slope}})
                                   .job;
        const scene::SceneFile file = scene::load_scene(job.scene);
        const raster_gl::Context context;
        const api::LoadedScene session{context, file.scene, {}};
        analysis::Comparison comparison = analysis::compare(job, file, session.renderers());
        rule = analysis::lookup_rule(job, comparison.view);
        lookup = std::move(comparison.lookup);
        classes = std::move(comparison.truth.pixel_class);
    }
};

void curve_against_std_sort(benchmark::State& state, const std::string& builtin, const char* slope)
{
    const Subject subject{builtin, slope};
    const auto criticals = analysis::critical_biases(subject.lookup, subject.rule);
    double curve_s = 0;
    double sort_s = 0;
    for (auto _ : state) {
        std::vector<float> values{criticals.begin(), criticals.end()};
        sort_s += seconds_of([&] { std::sort(values.begin(), values.end()); });
        benchmark::DoNotOptimize(values.data());
        const double once_s = seconds_of([&] {
            const auto found = analysis::critical_biases(subject.lookup, subject.rule);
            const analysis::BiasCurve curve{found, subject.classes};
            auto best = analysis::find_best_biases(curve);
            benchmark::DoNotOptimize(best);
        });
        state.SetIterationTime(once_s);
        curve_s += once_s;
    }
    const auto count = static_cast<double>(state.iterations());
    state.counters["std_sort_ms"] = 1000 * sort_s / count;
    state.counters["ratio"] = curve_s / sort_s;
}

void add(const std::string& builtin, const std::string& name, const char* slope)
{
    benchmark::RegisterBenchmark(("bias_curve/" + builtin + "/1080p/" + name).c_str(),
                                 [builtin, slope](benchmark::State& state) {
                                     curve_against_std_sort(state, builtin, slope);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->MinTime(1.0);
}

} // namespace
} // namespace gnomon::benchmarks

int main(int argc, char** argv)
{
    for (const char* builtin : {"sphere-field", "columns"}) {
        gnomon::benchmarks::add(builtin, "constant", "0");
        gnomon::benchmarks::add(builtin, "slope", "0.0005");
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
