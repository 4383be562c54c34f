#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/source.hpp"
#include "straight_comparison.hpp"
#include "sweep_world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

template <typename Value>
std::string text_of(const std::optional<Value>& value)
{
    return value ? fmt::format("{}", *value) : "none";
}

inline std::string text_of(const std::optional<Quantiles>& value)
{
    return value ? fmt::format("{} {} {} {} {}", value->count, value->min, value->median,
                               value->p95, value->max)
                 : "none";
}

inline std::string text_of(const ErrorBucket& cell)
{
    std::string text =
        fmt::format("{} {} {} {}", cell.object, cell.band.index, cell.lit, cell.blocked);
    for (const KindOfError& kind : cell.errors) {
        text += fmt::format(" {}{}{}:{} {}", kind.is_false_lit, static_cast<int>(kind.cause),
                            static_cast<int>(kind.label), kind.pixels, kind.amount);
    }
    return text;
}

/// A row as text; equal texts mean results equal bit by bit.
inline std::string text_of(const ConfigurationResult& result)
{
    std::string cells;
    for (const ErrorBucket& cell : result.cells) {
        cells += text_of(cell) + ';';
    }
    const Metrics& metrics = result.metrics;
    return fmt::format(
        "{} | {} | {} {} {} {} {} {} | {} | {} | {} | {} | {}", metrics.pixels.by_class,
        metrics.pixels.by_reason, metrics.false_shadow, metrics.false_lit,
        text_of(metrics.false_shadow_rate), text_of(metrics.false_lit_rate),
        text_of(metrics.error_rate), text_of(metrics.mean_abs_error),
        result.causes ? fmt::format("{}", result.causes->by_cause) : "none",
        result.causes ? fmt::format("{}", result.causes->by_label) : "none",
        text_of(result.peter_panning.metres), text_of(result.peter_panning.texels), cells);
}

inline std::string text_of(const std::vector<ErrorBin>& bins)
{
    std::string text;
    for (const ErrorBin& bin : bins) {
        text += fmt::format("[{} {}: {} {} {} {} | {} | {}]", bin.lower, bin.upper, bin.counts.lit,
                            bin.counts.blocked, bin.counts.false_shadow, bin.counts.false_lit,
                            text_of(bin.needed_bias), text_of(bin.map_error_m));
    }
    return text;
}

/// A sweep of the fake world, and its results.
class FakeSweep {
public:
    SweepWorld world;
    SweepHooks hooks;
    scene::SweepSpace space;
    std::map<std::uint64_t, std::string> done;   ///< results by ordinal
    std::map<std::uint64_t, std::string> failed; ///< messages by ordinal
    std::set<std::uint64_t> may_be_retried;      ///< ordinals of failures that a retry may help
    std::set<std::uint64_t> need_other_keys;     ///< ordinals of failures that need other keys
    std::map<std::string, CurveResult> curves;   ///< by their id
    std::vector<std::uint64_t> kept;
    PlanCounts planned;
    std::size_t slots = 2;

    explicit FakeSweep(const std::vector<std::string>& axes,
                       const std::vector<scene::Override>& overrides = {},
                       const std::vector<scene::CaseLayer>& cases = {})
        : space{source(overrides, cases), axes}
    {
        hooks.open_scene = [this](const scene::Job&) {
            return OpenScene{&world.file(), &world.renderers()};
        };
        hooks.record = [this](const FinishedCurve& finished) {
            for (const FinishedCurve::Row& row : finished.rows) {
                EXPECT_TRUE(done.emplace(row.ordinal, text_of(row.result)).second) << row.ordinal;
            }
            EXPECT_FALSE(finished.rows.empty());
            curves.insert_or_assign(finished.curve.id, finished.curve);
        };
        hooks.record_failure = [this](std::span<const std::uint64_t> ordinals,
                                      const std::string& message, Retry retry) {
            (retry == Retry::may_help ? may_be_retried : need_other_keys)
                .insert(ordinals.begin(), ordinals.end());
            for (const std::uint64_t ordinal : ordinals) {
                EXPECT_TRUE(failed.emplace(ordinal, message).second) << ordinal << " failed twice";
            }
        };
        hooks.should_stop = [] { return false; };
    }

    void keep_pixels()
    {
        hooks.keep_pixels = [this](std::uint64_t ordinal, const Comparison& comparison) {
            EXPECT_EQ(scene::resolved_keys(comparison.job),
                      scene::resolved_keys(space.job(space.at(ordinal))));
            kept.push_back(ordinal);
        };
    }

    PlanCounts run()
    {
        const SweepCurves sweep_curves{space, static_cast<bool>(hooks.keep_pixels), "1.0"};
        const auto& requests = sweep_curves.requests();
        const SweepPlan plan = make_plan(requests, slots);
        planned = plan.counts(requests);
        hooks.task = [&](std::size_t curve) { return sweep_curves.task(curve, {"hash", ""}); };
        return run_sweep(plan, hooks);
    }

    /// The configuration's comparison, in a world of its own.
    [[nodiscard]] Comparison compared(std::uint64_t ordinal) const
    {
        const SweepWorld other;
        const scene::Job job = space.job(space.at(ordinal));
        Comparison comparison = tests::compare_straight(
            begin_comparison(job, other.file(), summarise_scene(job.scene, other.file().scene),
                             other.renderers()),
            other.renderers());
        comparison.triangles = &world.file().scene;
        return comparison;
    }
    [[nodiscard]] std::size_t calls(std::string_view stage) const
    {
        return static_cast<std::size_t>(
            std::count(world.calls.begin(), world.calls.end(), std::string{stage}));
    }

private:
    static scene::JobSource source(const std::vector<scene::Override>& overrides,
                                   const std::vector<scene::CaseLayer>& cases)
    {
        scene::JobSource source = scene::builtin_job_source("wall", overrides);
        for (const scene::Setting& setting :
             scene::layer_from_overrides(*scene::own_keys(), {{"camera.target", "[0, 0, 0]"},
                                                              {"camera.up", "[0, 0, 1]"},
                                                              {"light.direction", "[0, -1, 0]"},
                                                              {"image.width", "9"},
                                                              {"image.height", "7"},
                                                              {"shadow_map.near", "-2"},
                                                              {"shadow_map.resolution", "6"},
                                                              {"bias.constant", "0"}})) {
            source.file.push_back(setting);
        }
        source.cases = cases;
        if (cases.empty()) {
            source.file.push_back(
                scene::layer_from_overrides(*scene::own_keys(), {{"camera.eye", "[0, 5, 0]"}})[0]);
        }
        return source;
    }
};

inline scene::CaseLayer case_of(const std::string& name, const std::vector<scene::Override>& keys)
{
    return {name, scene::layer_from_overrides(*scene::own_keys(), keys)};
}

inline std::vector<scene::CaseLayer> two_cameras()
{
    return {case_of("left", {{"camera.eye", "[1, 5, 0]"}}),
            case_of("right", {{"camera.eye", "[2, 6, 0]"}})};
}

inline std::string result_text(const Comparison& comparison)
{
    return text_of(finish_compared(comparison, "", 0).rows.front().result);
}

/// Expects every row to equal a comparison of its own.
inline void expect_compared(const FakeSweep& sweep)
{
    EXPECT_EQ(sweep.done.size() + sweep.failed.size(), sweep.space.size());
    for (const auto& [ordinal, text] : sweep.done) {
        EXPECT_EQ(text, result_text(sweep.compared(ordinal))) << "ordinal " << ordinal;
    }
}

} // namespace gnomon::analysis
