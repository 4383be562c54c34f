#include "analysis/bias_curve.hpp"
#include "analysis/critical_bias.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// The bias curve of two million pixels, critical biases included, against one `std::sort` of as
/// many critical biases, side by side in every iteration.
namespace gnomon::benchmarks {
namespace {

constexpr scene::ImageSize full_hd{1920, 1080};

double seconds_of(const auto& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Receivers on a slope over texels, every third in a shadow, one in eight not scored.
struct Subject {
    scene::LookupLayers lookup{scene::Image<scene::LookupSample>{full_hd}};
    scene::Image<scene::PixelClass> classes{full_hd};
    analysis::LookupRule rule;

    explicit Subject(float slope)
    {
        rule.slope = slope;
        std::mt19937 random{1};
        std::uniform_real_distribution<float> unit{0.0F, 1.0F};
        for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
            const float r = 0.25F + 0.5F * unit(random);
            const bool is_blocked = random() % 3 == 0;
            const float gap = is_blocked ? 0.2F * unit(random) : 0.002F * (unit(random) - 0.5F);
            lookup.samples[i] = {r, r - gap, 2.0F * unit(random), 0.0F};
            classes[i] = is_blocked ? scene::PixelClass::blocked : scene::PixelClass::lit;
            if (random() % 8 == 0) {
                classes[i] = scene::PixelClass::background;
            }
        }
    }
};

void curve_against_std_sort(benchmark::State& state, float slope)
{
    const Subject subject{slope};
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
            const auto best = analysis::find_best_biases(curve);
            benchmark::DoNotOptimize(best);
        });
        state.SetIterationTime(once_s);
        curve_s += once_s;
    }
    const auto count = static_cast<double>(state.iterations());
    state.counters["std_sort_ms"] = 1000 * sort_s / count;
    state.counters["ratio"] = curve_s / sort_s;
}

} // namespace
} // namespace gnomon::benchmarks

int main(int argc, char** argv)
{
    for (const auto& [name, slope] : {std::pair{"constant", 0.0F}, std::pair{"slope", 0.0005F}}) {
        benchmark::RegisterBenchmark((std::string{"bias_curve/1080p/"} + name).c_str(),
                                     gnomon::benchmarks::curve_against_std_sort, slope)
            ->Unit(benchmark::kMillisecond)
            ->UseManualTime()
            ->MinTime(1.0);
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
