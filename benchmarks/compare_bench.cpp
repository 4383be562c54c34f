#include "analysis/comparison/comparison.hpp"
#include "analysis/sweep/compare.hpp"
#include "raw_embree.hpp"
#include "scene/job/file.hpp"
#include "subject.hpp"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

/// Compares the whole comparison to the sum of its raw parts: one shadow pass, one receiver pass,
/// one lookup with its readback, one raw Embree pass. Each iteration measures all.
namespace gnomon::benchmarks {
namespace {

/// Sums over iterations; counters show the means.
struct Sums {
    double shadow_map = 0;
    double receivers = 0;
    double lookup = 0;
    double embree = 0;
    double whole = 0;

    [[nodiscard]] double raw() const { return shadow_map + receivers + lookup + embree; }
};

analysis::Comparison compare(const Subject& subject, reference_rt::TruthMethod method)
{
    const reference_rt::EmbreeReference truth{*subject.reference, {method, 0}};
    return analysis::compare(subject.job, subject.file, {*subject.gl, truth, {}});
}

void measure_once(const Subject& subject, reference_rt::TruthMethod method, RawEmbreePass& raw,
                  const scene::View& view, Sums& sums)
{
    raster_gl::GlRasterizer& gl = *subject.gl;
    renderers::Drawn drawn;
    sums.shadow_map +=
        seconds_of([&] { drawn.map = renderers::draw_filtered_map(gl, subject.job, view); });
    sums.receivers += seconds_of([&] {
        drawn.receivers = gl.draw_receivers(view);
        benchmark::DoNotOptimize(drawn.receivers->layers().triangle.data());
    });
    sums.lookup += seconds_of([&] {
        benchmark::DoNotOptimize(gl.look_up({drawn, subject.job, view}).samples.data());
    });
    sums.embree += seconds_of([&] { benchmark::DoNotOptimize(raw.run()); });
    sums.whole +=
        seconds_of([&] { benchmark::DoNotOptimize(compare(subject, method).metrics.false_lit); });
}

void compare_against_raw_parts(benchmark::State& state, const std::string& builtin,
                               const std::vector<scene::Override>& keys,
                               reference_rt::TruthMethod method)
{
    const Subject subject{scene::builtin_job(builtin, keys).job};
    const analysis::Comparison first = compare(subject, method); // compiles, allocates
    const auto points =
        reference_rt::receiver_points(subject.file.scene, first.view, first.receivers.triangle);
    RawEmbreePass raw{subject.file.scene, first.view, first.truth, points};
    Sums sums;
    for (auto _ : state) {
        const double before = sums.whole;
        measure_once(subject, method, raw, first.view, sums);
        state.SetIterationTime(sums.whole - before);
    }
    const auto mean_ms = [&](double sum) {
        return 1000 * sum / static_cast<double>(state.iterations());
    };
    state.counters["ratio"] = sums.whole / sums.raw();
    state.counters["raw_ms"] = mean_ms(sums.raw());
    state.counters["raw_map_ms"] = mean_ms(sums.shadow_map);
    state.counters["raw_receivers_ms"] = mean_ms(sums.receivers);
    state.counters["raw_lookup_ms"] = mean_ms(sums.lookup);
    state.counters["raw_embree_ms"] = mean_ms(sums.embree);
    state.counters["rays"] = static_cast<double>(raw.ray_count());
    state.counters["scene_ms"] = 1000 * subject.scene_s;
    state.counters["upload_ms"] = 1000 * subject.upload_s;
    state.counters["bvh_ms"] = 1000 * subject.bvh_s;
}

const std::vector<scene::Override> full_hd{{"image.width", "1920"},
                                           {"image.height", "1080"},
                                           {"shadow_map.resolution", "2048"},
                                           {"lookup.filter", "nearest"}};

void add(const std::string& builtin, const std::string& method_name,
         reference_rt::TruthMethod method)
{
    benchmark::RegisterBenchmark(("compare/" + builtin + "/1080p/" + method_name).c_str(),
                                 [builtin, method](benchmark::State& state) {
                                     compare_against_raw_parts(state, builtin, full_hd, method);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->MinTime(3.0);
}

} // namespace
} // namespace gnomon::benchmarks

int main(int argc, char** argv)
{
    using gnomon::reference_rt::TruthMethod;
    for (const char* builtin : {"sphere-field", "columns"}) {
        gnomon::benchmarks::add(builtin, "float", TruthMethod::plain);
        gnomon::benchmarks::add(builtin, "exact", TruthMethod::exact);
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
