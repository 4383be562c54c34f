#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "raw_embree.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/source.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "subject.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

/// Compares a whole sweep by the program, with database and CSV files, to its lower limit: its GL
/// passes with readbacks and allocated textures, and one raw Embree pass for each truth and each
/// distinct set of texel-centre rays. Also compares it to `gnomon compare` for some of its
/// configurations.
namespace gnomon::benchmarks {
namespace {

namespace fs = std::filesystem;
using Kind = analysis::SweepStep::Kind;

constexpr std::string_view spot = R"(type = "spot"
position = [-14, 19, 10]
target = [0, 0, 0]
cone_deg = 60)";
constexpr std::string_view sun = R"(type = "directional"
direction = [0.5, -1, -0.35])";
constexpr std::string_view point = R"(type = "point"
position = [0.3, 8, 0.2])";

/// The varied settings of the sweeps.
struct SweepShape {
    std::string_view light = spot;
    std::string_view resolutions = "512, 1024, 2048, 4096, 8192";
    std::string_view near_m = "0.1, 0.3, 0.6, 1, 2";
    std::string_view map = {}; ///< more of `[shadow_map]`
};

/// columns at 1280×720: 1000 biases × resolutions × 4 formats × near planes × 2 cameras.
std::string job_text(const SweepShape& shape)
{
    return fmt::format(R"([scene]
builtin = "columns"
[image]
width = 1280
height = 720
[light]
{}
[shadow_map]
{}
[sweep]
"bias.constant" = {{from = 1e-7, to = 1e-2, count = 1000, scale = "log"}}
"shadow_map.resolution" = [{}]
"shadow_map.depth_format" = ["d16", "d24", "d32", "d32f"]
"shadow_map.near" = [{}]
[[case]]
name = "corner"
camera.eye = [11.5, 3.6, 11.5]
[[case]]
name = "front"
camera.eye = [2, 4, 16]
)",
                       shape.light, shape.map, shape.resolutions, shape.near_m);
}

/// An empty folder; the destructor removes it.
class Folder {
public:
    Folder()
    {
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_ =
        fs::temp_directory_path() / ("gnomon_sweep_bench." + std::to_string(::getpid()));
};

fs::path program()
{
    return fs::read_symlink("/proc/self/exe").parent_path() / "gnomon";
}

/// Measures the lower limit of a plan's time.
class Floor {
public:
    Floor(const analysis::SweepCurves& sweep_curves, Subject& subject)
        : sweep_curves_{sweep_curves},
          subject_{subject}
    {
    }

    double gl_s = 0;
    double embree_s = 0;

    void run(const analysis::SweepPlan& plan)
    {
        for (const analysis::SweepStep& step : plan.steps) {
            const scene::Job job = sweep_curves_.job(step.curve);
            const scene::View view =
                scene::resolve_view(job, subject_.file.scene, subject_.file.defaults);
            do_step(step, job, view);
        }
    }

private:
    void do_step(const analysis::SweepStep& step, const scene::Job& job, const scene::View& view)
    {
        switch (step.kind) {
        case Kind::draw_receivers:
            draw_receivers(step.slot, view);
            gl_s += seconds_of([&] { draw_receivers(step.slot, view); });
            break;
        case Kind::find_truth:
            trace(step.slot, view);
            break;
        case Kind::draw_shadow_map:
            draw_map(job, view);
            gl_s += seconds_of([&] { draw_map(job, view); });
            break;
        case Kind::prefilter:
            filter_map(job, view);
            gl_s += seconds_of([&] { filter_map(job, view); });
            break;
        case Kind::look_up:
            if (filtered_ == nullptr) {
                filter_map(job, view);
            }
            gl_s += seconds_of([&] {
                const renderers::Drawn drawn{receivers_[step.slot], filtered_};
                benchmark::DoNotOptimize(subject_.gl->look_up({drawn, job, view}).samples.data());
            });
            // There are at most as many texel-centre rays as visible receivers.
            if (texel_rays_.insert(analysis::stage_keys(job).exact).second) {
                embree_s += seconds_of([&] { benchmark::DoNotOptimize(raw_->run()); });
            }
            break;
        case Kind::read_scene:
        case Kind::answer:
            break;
        }
    }

    void draw_receivers(std::size_t slot, const scene::View& view)
    {
        receivers_[slot].reset();
        receivers_[slot] = subject_.gl->draw_receivers(view);
        layers_ = receivers_[slot]->layers();
    }
    void draw_map(const scene::Job& job, const scene::View& view)
    {
        filtered_.reset();
        map_.reset();
        map_ = subject_.gl->draw_map(job, view, {});
    }
    void filter_map(const scene::Job& job, const scene::View& view)
    {
        filtered_.reset();
        filtered_ = subject_.gl->filter_map(map_, job, view, renderers::FilteredContent::of_method);
    }

    void trace(std::size_t slot, const scene::View& view)
    {
        const auto& triangles = subject_.file.scene;
        const auto truth = reference_rt::compute_truth(*subject_.reference, view, layers_.triangle,
                                                       receivers_[slot]->raster_facts(),
                                                       {reference_rt::TruthMethod::exact, 0});
        const auto points = reference_rt::receiver_points(triangles, view, layers_.triangle);
        raw_ = std::make_unique<RawEmbreePass>(triangles, view, truth, points);
        benchmark::DoNotOptimize(raw_->run());
        embree_s += seconds_of([&] { benchmark::DoNotOptimize(raw_->run()); });
    }

    const analysis::SweepCurves& sweep_curves_;
    Subject& subject_;
    std::map<std::size_t, std::shared_ptr<const renderers::Receivers>> receivers_; ///< by slot
    scene::ReceiverLayers layers_;                                                 ///< drawn last
    std::shared_ptr<const renderers::ShadowMap> map_;
    std::shared_ptr<const renderers::FilteredMap> filtered_;
    std::unique_ptr<RawEmbreePass> raw_;
    std::set<std::string> texel_rays_;
};

/// Runs a program and discards its output.
/// @throws std::runtime_error  if the program cannot be run, or fails.
void run_program(std::vector<std::string> words)
{
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int error =
        ::posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (error != 0 || ::waitpid(child, &status, 0) != child || status != 0) {
        throw std::runtime_error{fmt::format("sweep_bench: {} {} failed", words[0], words[1])};
    }
}

/// Mean wall time of `gnomon compare --json` over some of the sweep's configurations [s].
double compare_s(const scene::SweepSpace& space)
{
    constexpr std::uint64_t runs = 5;
    double sum_s = 0;
    for (std::uint64_t i = 0; i < runs; ++i) {
        const scene::Job job = space.job(space.at(i * (space.size() - 1) / (runs - 1)));
        std::vector<std::string> words{program().string(), "compare", "--json", "--builtin",
                                       job.scene.builtin};
        for (const auto& [key, value] : scene::resolved_keys(job)) {
            if (!key.starts_with("scene.")) {
                words.emplace_back("--set");
                words.push_back(key);
                words.back() += '=';
                words.back() += value;
            }
        }
        sum_s += seconds_of([&] { run_program(words); });
    }
    return sum_s / runs;
}

void sweep_against_floor(benchmark::State& state, const SweepShape& shape)
{
    const Folder folder;
    const fs::path job = folder.path() / "job.toml";
    const fs::path run = folder.path() / "run";
    std::ofstream{job} << job_text(shape);
    const scene::SweepSpace space{scene::read_job_source(job, {}), {}};
    const analysis::SweepCurves sweep_curves{space, false, "bench"};
    const auto& requests = sweep_curves.requests();
    const auto plan = analysis::make_plan(requests, analysis::camera_slots(requests));
    double floor_s = 0;
    double gl_s = 0;
    double sweep_s = 0;
    for (auto _ : state) {
        {
            Subject subject{sweep_curves.job(0)};
            Floor floor{sweep_curves, subject};
            floor.run(plan);
            floor_s += floor.gl_s + floor.embree_s;
            gl_s += floor.gl_s;
        }
        fs::remove_all(run);
        const double now_s = seconds_of([&] {
            run_program({program().string(), "sweep", job.string(), "--out", run.string(),
                         "--quiet", "--no-keep-pixels"});
        });
        sweep_s += now_s;
        state.SetIterationTime(now_s);
    }
    const auto runs = static_cast<double>(state.iterations());
    const auto configurations = static_cast<double>(space.size());
    state.counters["ratio"] = sweep_s / floor_s;
    state.counters["floor_s"] = floor_s / runs;
    state.counters["floor_gl_s"] = gl_s / runs;
    state.counters["us_each"] = 1e6 * sweep_s / runs / configurations;
    state.counters["compare_s"] = compare_s(space);
    state.counters["faster_than_compare"] =
        state.counters["compare_s"] / (sweep_s / runs / configurations);
    state.counters["maps"] = static_cast<double>(plan.counts(requests).shadow_maps);
    state.counters["lookups"] = static_cast<double>(plan.counts(requests).lookup_passes);
}

constexpr SweepShape small{spot, "1024, 4096", "0.1, 0.6"};
constexpr SweepShape one_map{spot, "512, 2048", "0.1, 0.6"};
constexpr SweepShape six_maps{point, "512, 2048", "0.1, 0.6"};
constexpr SweepShape suns_map{sun, "512, 2048", "-60, -40"};
constexpr SweepShape cascades{sun, "512, 2048", "-60, -40", "layout = \"cascades\""};

BENCHMARK_CAPTURE(sweep_against_floor, columns_32000, small)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(sweep_against_floor, columns_spot_32000, one_map)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(sweep_against_floor, columns_cube_32000, six_maps)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(sweep_against_floor, columns_sun_32000, suns_map)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(sweep_against_floor, columns_cascades_32000, cascades)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(sweep_against_floor, columns_200000, SweepShape{})
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(1);

} // namespace
} // namespace gnomon::benchmarks

BENCHMARK_MAIN();
