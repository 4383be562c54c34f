#include "example_run.hpp"

#include "example_comparison.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

namespace gnomon::store {

namespace {

std::string example_id(std::uint64_t number, char kind)
{
    return fmt::format("{}{:015x}", kind, number * 0x9E3779B97F4A7C15U >> 4U);
}

float bias_of(std::uint64_t index)
{
    return static_cast<float>(1e-6 * std::pow(1.01, static_cast<double>(index)));
}

analysis::Quantiles quantiles(float scale)
{
    return {12, 0.1F * scale, 0.3F * scale, 0.7F * scale, 1.1F * scale};
}

analysis::ConfigurationResult example_result(std::uint64_t ordinal)
{
    analysis::ConfigurationResult result;
    analysis::ClassCounts pixels;
    pixels.total = 921'600;
    pixels.by_class = {300'000, 30, 22'000, 61'570, 0, 380'000, 158'000};
    pixels.by_reason = {921'570, 30, 0, 0, 0, 0, 0};
    const std::uint64_t false_shadow = 1000 + ordinal % 997;
    const std::uint64_t false_lit = ordinal % 13;
    result.metrics = analysis::make_metrics(
        pixels, {false_shadow,
                 false_lit,
                 {static_cast<double>(false_shadow), static_cast<double>(false_lit), 0, 0}});
    result.causes =
        analysis::CauseCounts{{0, 1, 2, result.metrics.false_shadow - 3, result.metrics.false_lit},
                              {0, result.metrics.false_shadow, result.metrics.false_lit, 0, 0, 0}};
    std::ranges::copy(result.causes->by_cause, result.amounts.by_cause.begin());
    std::ranges::copy(result.causes->by_label, result.amounts.by_label.begin());
    if (ordinal % 2 == 0) {
        result.peter_panning.metres = quantiles(0.01F);
        result.peter_panning.texels = quantiles(3);
    }
    return result;
}

analysis::MapResult example_map(std::uint64_t ordinal, std::uint64_t map)
{
    const auto place = static_cast<double>(map);
    analysis::MapResult result;
    result.facts = {std::to_string(map), 0.1 + place, 10.0 / 3, 0.01 * (place + 1),
                    place + 1,           place + 2,   {}};
    result.facts.bias = analysis::MapBias{0, 0.001 / 3 * static_cast<double>(ordinal + 1), 0, 0};
    result.errors.counts = {1000 + map, 500, 10 + ordinal, map, 10.25 + place, place / 3};
    result.errors.causes.by_cause = {0, 1, 2, 7 + ordinal, map, 0};
    return result;
}

analysis::BiasLimits limits(double allowance, float scale)
{
    return {allowance,   5, 0.001F * scale, 0.0005F * scale, std::numeric_limits<float>::infinity(),
            0.3F * scale};
}

std::vector<analysis::ErrorBin> bins(std::uint64_t number)
{
    std::vector<analysis::ErrorBin> result;
    for (std::uint64_t i = 0; i < 32; ++i) {
        const auto lower = static_cast<double>(i) / 3;
        analysis::ErrorBin bin{
            lower,
            static_cast<double>(i + 1) / 3,
            {1000 * i, 77, 10 * i, number % 7, 10.5 * static_cast<double>(i), 0.5}};
        bin.needed_bias = quantiles(1e-4F);
        result.push_back(bin);
    }
    return result;
}

analysis::CurveResult curve_result(std::uint64_t number)
{
    analysis::CurveResult curve;
    curve.id = example_id(number, 'c');
    curve.near_m = 0.1 * static_cast<double>(number + 1);
    curve.far_m = 10 + 1.0 / 3;
    curve.map_bytes = 4 << 20U;
    curve.best = analysis::BestBiases{{0.001F, 0.002F}, {7, 8}};
    curve.bounds = analysis::BiasBounds{
        limits(0, 1), {limits(0.0001, 2), limits(0.001, 3), limits(0.01, 4)}, number % 2 == 0};
    for (std::uint64_t i = 0; i < 100; ++i) {
        const std::uint64_t shadow = 1000 - 10 * i;
        curve.points.push_back({bias_of(10 * i),
                                {2000, 1000, shadow, number + i, static_cast<double>(shadow) + 0.25,
                                 static_cast<double>(number + i) / 3}});
    }
    curve.by_distance = {{analysis::DistanceProfile::At::job_bias, 0, bins(number)},
                         {analysis::DistanceProfile::At::best_bias, 0.0015F, bins(number + 1)}};
    return curve;
}

} // namespace

RunDescription ExampleRun::description(std::uint32_t shard) const
{
    RunDescription description;
    description.environment = {"llvmpipe", "4.5 Mesa", "Embree 3.13.5", "Gnomon 0.1.0"};
    description.shard = {shard, shards};
    description.size = curves * biases;
    description.axes = {"shadow_map.resolution", "bias.constant"};
    description.job = "[scene]\nbuiltin = \"wall\"\n";
    description.command = "gnomon sweep job.toml";
    return description;
}

std::vector<analysis::Configuration> ExampleRun::configurations() const
{
    std::vector<analysis::Configuration> all;
    all.reserve(curves * biases);
    for (std::uint64_t c = 0; c < curves; ++c) {
        std::ranges::move(configurations_of(c), std::back_inserter(all));
    }
    return all;
}

std::vector<analysis::Configuration> ExampleRun::configurations_of(std::uint64_t curve) const
{
    std::vector<analysis::Configuration> all;
    scene::Job job = scene::builtin_job("wall").job;
    job.bias.constant_m.reset();
    job.shadow_map.resolution_texels = static_cast<int>(256 + curve);
    for (std::uint64_t b = 0; b < biases; ++b) {
        job.bias.constant = double{bias_of(b)};
        const std::uint64_t ordinal = curve * biases + b;
        all.push_back({ordinal, example_id(1000 * biases + ordinal, 'a'), example_id(curve, 'c'),
                       "noon", "0123456789abcdef", static_cast<std::uint32_t>(curve % shards + 1),
                       "0", scene::resolved_keys(job)});
    }
    return all;
}

analysis::FinishedCurve ExampleRun::curve(std::uint64_t number) const
{
    analysis::FinishedCurve finished;
    finished.curve = curve_result(number);
    for (std::uint64_t b = 0; b < biases; ++b) {
        const std::uint64_t ordinal = number * biases + b;
        finished.rows.push_back({ordinal, example_result(ordinal)});
        for (std::uint64_t map = 0; map < maps && maps > 1; ++map) {
            finished.rows.back().result.by_map.push_back(example_map(ordinal, map));
        }
    }
    return finished;
}

void ExampleRun::record(RunStore& store, std::uint32_t shard,
                        const std::set<std::uint64_t>& left_out) const
{
    for (std::uint64_t c = shard - 1; c < curves; c += shards) {
        if (!left_out.contains(c)) {
            store.record(curve(c));
        }
    }
}

void ExampleRun::compute(const std::filesystem::path& folder, std::uint32_t shard) const
{
    std::filesystem::create_directories(folder);
    RunStore store{folder, RunStore::Access::write};
    store.plan(description(shard), configurations());
    record(store, shard);
    store.write_csv();
}

std::string csv_texts(const std::filesystem::path& folder)
{
    return read_text(folder / "results.csv") + read_text(folder / "error_vs_z.csv") +
           read_text(folder / "bias_curves.csv");
}

} // namespace gnomon::store
