#include "analysis/causes/find_causes.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "reference_rt/truth.hpp"
#include "scene/job/file.hpp"
#include "subject.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <limits>

/// Compares the causes of all pixels for all biases to the exact truth of these pixels, without
/// building hierarchies. Each iteration measures both.
namespace gnomon::benchmarks {
namespace {

/// The blocked pixels that are lit without bias.
scene::Image<std::uint8_t> false_lit(const scene::Truth& truth, const scene::LookupLayers& unbiased)
{
    scene::Image<std::uint8_t> pixels{truth.pixel_class.size()};
    for (std::size_t i = 0; i < pixels.pixel_count(); ++i) {
        pixels[i] =
            scene::is_blocked(truth.pixel_class[i]) && scene::is_lit(unbiased.samples[i].verdict);
    }
    return pixels;
}

void causes_against_truth(benchmark::State& state)
{
    const scene::Job job = scene::builtin_job("sphere-field", {{"image.width", "1920"},
                                                               {"image.height", "1080"},
                                                               {"shadow_map.resolution", "2048"},
                                                               {"lookup.filter", "nearest"}})
                               .job;
    const Subject subject{job};
    renderers::Rasterizer& rasterizer = *subject.gl;
    const renderers::Reference& reference = *subject.truth;
    scene::View view = scene::resolve_view(job, subject.file.scene, subject.file.defaults);
    view.bias = {};
    const renderers::Drawn drawn{rasterizer.draw_receivers(view),
                                 renderers::draw_filtered_map(rasterizer, job, view)};
    const scene::ReceiverLayers receivers = drawn.receivers->layers();
    const scene::LookupLayers unbiased = rasterizer.look_up({drawn, job, view});
    double truth_s = std::numeric_limits<double>::infinity();
    double causes_s = truth_s;
    for (auto _ : state) {
        scene::Truth truth;
        truth_s = std::min(truth_s, seconds_of([&] {
                               truth = reference.find_truth(view, receivers,
                                                            drawn.receivers->raster_facts());
                           }));
        const scene::Image<float> no_depths;
        const double now_s = seconds_of([&] {
            const auto light = reference.make_light_queries(job, view, receivers);
            const analysis::CauseInputs inputs{analysis::lookup_rule(job, view),
                                               job.shadow_map.resolution_texels,
                                               truth,
                                               unbiased,
                                               unbiased,
                                               no_depths,
                                               *light};
            analysis::PixelCauses causes{scene::Image<analysis::PixelCause>{view.image}, {}};
            find_lit_causes(inputs, causes);
            find_blocked_causes(inputs, false_lit(truth, unbiased), causes);
            benchmark::DoNotOptimize(causes.pixels.data());
        });
        causes_s = std::min(causes_s, now_s);
        state.SetIterationTime(now_s);
    }
    state.counters["ratio"] = causes_s / truth_s;
    state.counters["truth_ms"] = 1000 * truth_s;
    state.counters["causes_ms"] = 1000 * causes_s;
}

BENCHMARK(causes_against_truth)
    ->Name("causes/sphere-field/1080p/2048")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->MinTime(3.0);

} // namespace
} // namespace gnomon::benchmarks

BENCHMARK_MAIN();
