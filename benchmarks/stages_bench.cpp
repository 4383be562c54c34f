#include "methods/key_table.hpp"
#include "scene/job/file.hpp"
#include "subject.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

/// Measures GL's passes one by one, with the readbacks that the lookup needs: `columns` at
/// 1280×720.
namespace gnomon::benchmarks {
namespace {

scene::Job make_job(const std::vector<scene::Override>& keys)
{
    std::vector<scene::Override> all{{"image.width", "1280"}, {"image.height", "720"}};
    all.insert(all.end(), keys.begin(), keys.end());
    return scene::builtin_job("columns", all, gnomon::methods::key_table()).job;
}

/// A subject whose receivers and map were drawn once, to allocate everything.
struct Drawn {
    explicit Drawn(const scene::Job& job)
        : subject{job},
          view{scene::resolve_view(job, subject.file.scene, subject.file.defaults)}
    {
        draw();
    }

    void draw()
    {
        both.receivers = subject.gl->draw_receivers(view);
        draw_map();
    }
    void draw_map()
    {
        both.map.reset();
        both.map = renderers::draw_filtered_map(*subject.gl, subject.job, view);
    }
    [[nodiscard]] scene::LookupLayers look_up()
    {
        return subject.gl->look_up({both, subject.job, view});
    }

    Subject subject;
    scene::View view;
    renderers::Drawn both;
};

/// Four maps with as many texels as one map of 2048².
std::vector<scene::Override> four_cascades()
{
    return {{"shadow_map.layout", "cascades"},
            {"shadow_map.cascades", "4"},
            {"shadow_map.resolution", "1024"}};
}

void shadow_pass(benchmark::State& state, const std::vector<scene::Override>& keys)
{
    Drawn drawn{make_job(keys)};
    for (auto _ : state) {
        drawn.draw_map();
    }
}

void receiver_pass(benchmark::State& state)
{
    Drawn drawn{make_job({})};
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            drawn.subject.gl->draw_receivers(drawn.view)->layers().triangle.data());
    }
}

void lookup_pass(benchmark::State& state, const std::vector<scene::Override>& keys)
{
    Drawn drawn{make_job(keys)};
    for (auto _ : state) {
        benchmark::DoNotOptimize(drawn.look_up().samples.data());
    }
}

/// All of a method's work for a frame: map, filtering and verdicts.
void verdicts(benchmark::State& state, const std::vector<scene::Override>& keys)
{
    Drawn drawn{make_job(keys)};
    for (auto _ : state) {
        drawn.draw_map();
        benchmark::DoNotOptimize(drawn.look_up().samples.data());
    }
}

void map_readback(benchmark::State& state, const std::string& resolution)
{
    Drawn drawn{make_job({{"shadow_map.resolution", resolution}})};
    for (auto _ : state) {
        benchmark::DoNotOptimize(drawn.both.map->map().depths().data());
    }
}

/// Measures processor time of all threads, including llvmpipe's. It depends less on the machine's
/// other load than wall time.
template <typename Pass>
void add(const std::string& name, Pass pass)
{
    benchmark::RegisterBenchmark(name.c_str(), std::move(pass))
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime();
}

void add_all()
{
    for (const char* resolution : {"512", "2048", "8192"}) {
        for (const char* format : {"d16", "d24", "d32f", "u16"}) {
            add(fmt::format("shadow_pass/{}/{}", resolution, format),
                [resolution, format](benchmark::State& state) {
                    shadow_pass(state, {{"shadow_map.resolution", resolution},
                                        {"shadow_map.depth_format", format}});
                });
        }
        add(fmt::format("map_readback/{}", resolution),
            [resolution](benchmark::State& state) { map_readback(state, resolution); });
    }
    add("receiver_pass", receiver_pass);
    for (const char* filter : {"nearest", "linear", "hardware", "pcf3", "pcf9"}) {
        add(fmt::format("lookup_pass/{}", filter), [filter](benchmark::State& state) {
            lookup_pass(state, {{"lookup.filter", filter}});
        });
    }
    for (const char* method : {"depth", "primitive_id", "vsm", "shadow_volumes"}) {
        add(fmt::format("verdicts/{}", method), [method](benchmark::State& state) {
            verdicts(state, {{"method.name", method}});
        });
    }
    add("verdicts/shadow_volumes/triangle", [](benchmark::State& state) {
        verdicts(state, {{"method.name", "shadow_volumes"}, {"method.extrusion", "triangle"}});
    });
    add("shadow_pass/4x1024/d24",
        [](benchmark::State& state) { shadow_pass(state, four_cascades()); });
    add("lookup_pass/4x1024/nearest",
        [](benchmark::State& state) { lookup_pass(state, four_cascades()); });
}

} // namespace
} // namespace gnomon::benchmarks

int main(int argc, char** argv)
{
    gnomon::benchmarks::add_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
