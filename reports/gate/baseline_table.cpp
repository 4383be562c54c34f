#include "reports/gate/baseline_table.hpp"

#include "analysis/gate/gate_judgement.hpp"
#include "analysis/gate/gate_metrics.hpp"
#include "reports/gate/gate_text.hpp"
#include "reports/text/text.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::reports {

namespace {

/// The image cells whose errors changed, if both are known; and whether the wrong pixels moved.
std::string differing_cells(const analysis::GateEntry& before, const analysis::GateEntry& now)
{
    std::string text;
    for (const analysis::ErrorBucket& cell : now.cells) {
        analysis::PixelFilter filter;
        filter.object = cell.object;
        filter.bands = analysis::LightDistanceBands{cell.band, cell.band};
        for (const std::string_view metric :
             {analysis::wrong_pixels_metric, analysis::error_amount_metric}) {
            const std::string name{metric};
            const auto was = before.metric(name, filter);
            const auto is = now.metric(name, filter);
            if (was && was != is) {
                text += fmt::format("  {} {} {} {}\n",
                                    pad_right(fmt::format("{}, {}", name, filter_text(filter)), 50),
                                    pad_left(metric_text(name, was), 12),
                                    pad_left(metric_text(name, is), 12),
                                    pad_left(change_text(name, was, is), 12));
            }
        }
    }
    if (!before.pixels.empty() && !now.pixels.empty() && before.pixels != now.pixels) {
        text += "  other pixels are wrong\n";
    }
    if (!before.pixels.empty() && now.pixels.empty()) {
        text += "  no mask of wrong pixels any more: the run kept no pixels\n";
    }
    return text;
}

/// The parameters and metrics that differ; may be empty.
std::string differing_lines(const analysis::GateEntry& before, const analysis::GateEntry& now)
{
    std::string text;
    for (const analysis::ParameterChange& change : analysis::changed_parameters(before, now)) {
        text += fmt::format("  {}\n", change_line(change));
    }
    for (const analysis::GateMetric& metric : analysis::gate_metrics()) {
        const std::string name{metric.name};
        const auto was = before.metric(name);
        const auto is = now.metric(name);
        if (was != is) {
            text += fmt::format(
                "  {} {} {} {}\n", pad_right(name, 50), pad_left(metric_text(name, was), 12),
                pad_left(metric_text(name, is), 12), pad_left(change_text(name, was, is), 12));
        }
    }
    return text + differing_cells(before, now);
}

std::string environment_difference(const analysis::Environment& before,
                                   const analysis::Environment& now)
{
    std::string text;
    if (!analysis::is_same_renderer(before, now)) {
        text += fmt::format("renderer: {} -> {}\n", renderer_text(before), renderer_text(now));
    }
    if (before.gnomon != now.gnomon) {
        text += fmt::format("gnomon: {} -> {}\n", scene::one_line(before.gnomon),
                            scene::one_line(now.gnomon));
    }
    return text;
}

} // namespace

std::string masks_text(const analysis::GateEntries& baseline)
{
    const auto masks = static_cast<std::size_t>(
        std::count_if(baseline.entries.begin(), baseline.entries.end(),
                      [](const analysis::GateEntry& entry) { return !entry.pixels.empty(); }));
    return masks == 0 ? "without masks of wrong pixels"
                      : fmt::format("with masks of wrong pixels for {}", grouped(masks));
}

std::string baseline_table(const analysis::GateEntries& baseline)
{
    std::string text = fmt::format(
        "{}, {}\n{}\n\n  {} {} {}  configuration\n", renderer_text(baseline.environment),
        scene::one_line(baseline.environment.gnomon),
        fmt::format("{}, {}", counted(baseline.entries.size(), "configuration"),
                    masks_text(baseline)),
        pad_left("false shadow", 14), pad_left("false lit", 14), pad_left("error rate", 12));
    for (const analysis::GateEntry& entry : baseline.entries) {
        text += fmt::format("  {} {} {}  {}\n",
                            pad_left(metric_text("false_shadow", entry.metric("false_shadow")), 14),
                            pad_left(metric_text("false_lit", entry.metric("false_lit")), 14),
                            pad_left(percent(entry.metric("error_rate")), 12),
                            store::key_text(entry.key));
    }
    return text;
}

std::string baseline_difference(const analysis::GateEntries& baseline,
                                const analysis::GateEntries& run)
{
    const analysis::GateOutcome outcome = analysis::judge_run(baseline, run, {});
    std::string text = environment_difference(baseline.environment, run.environment);
    std::size_t changed = 0;
    for (const analysis::GatePair& pair : outcome.pairs) {
        const analysis::GateEntry& now = run.entries[pair.now];
        const std::string lines = differing_lines(baseline.entries[pair.before], now);
        if (!lines.empty()) {
            ++changed;
            text += fmt::format("{}\n{}", store::key_text(now.key), lines);
        }
    }
    for (const std::size_t entry : outcome.missing) {
        text += fmt::format("missing: {}\n", store::key_text(baseline.entries[entry].key));
    }
    for (const std::size_t entry : outcome.added) {
        text += fmt::format("new: {}\n", store::key_text(run.entries[entry].key));
    }
    return text + fmt::format("{} of {} differ, {} missing, {} new\n", grouped(changed),
                              counted(outcome.pairs.size(), "configuration"),
                              grouped(outcome.missing.size()), grouped(outcome.added.size()));
}

} // namespace gnomon::reports
