#include "cli/sweep/sweep_text.hpp"

#include "reports/text/text.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace gnomon::cli {
namespace {

std::string duration_text(double seconds)
{
    if (seconds < 90) {
        return fmt::format("{:.0f} s", std::max(1.0, seconds));
    }
    return seconds < 5400 ? fmt::format("{:.0f} min", seconds / 60)
                          : fmt::format("{:.1f} h", seconds / 3600);
}

} // namespace

std::string axes_text(const scene::SweepSpace& space)
{
    std::string text;
    const std::string_view joint = space.mode() == "zip" ? " with " : " × ";
    for (const scene::SweepAxis& axis : space.axes()) {
        text += text.empty() ? std::string_view{} : joint;
        text += fmt::format("{} {}", reports::grouped(axis.values.size()), axis.key);
    }
    if (space.case_count() > 0) {
        text += text.empty() ? "" : " × ";
        text += reports::counted(space.case_count(), "case");
    }
    if (!space.lights().empty()) {
        text += text.empty() ? "" : " × ";
        text += reports::counted(space.lights().size(), "light");
    }
    return text.empty() ? "the job as it is" : text;
}

std::string counts_text(const analysis::PlanCounts& counts)
{
    const auto passes = [](std::uint64_t count, std::string_view kind) {
        return fmt::format("{} {} pass{}", reports::grouped(count), kind, count == 1 ? "" : "es");
    };
    const std::string prefilters =
        counts.prefilters > 0 ? passes(counts.prefilters, "prefilter") + ", " : std::string{};
    return fmt::format(
        "{}, {}, {}, {}, {}{}, {}", reports::counted(counts.scenes, "scene"),
        reports::counted(counts.truths, "truth"), passes(counts.receiver_passes, "receiver"),
        reports::counted(counts.shadow_maps, "shadow map"), prefilters,
        passes(counts.lookup_passes, "lookup"), reports::counted(counts.curves, "bias curve"));
}

std::string sweep_outcome_text(const std::string& folder, const api::SweepOutcome& outcome,
                               const std::string& work)
{
    std::string text = fmt::format("{} of {} done", reports::grouped(outcome.done),
                                   reports::counted(outcome.configurations, "configuration"));
    if (outcome.failed > 0) {
        text += fmt::format(", {} failed", reports::grouped(outcome.failed));
    }
    text += fmt::format(": {}/results.csv\n  now: {}\n", folder,
                        outcome.counts.configurations > 0 ? work : "nothing was left to do");
    if (outcome.repeated > 0) {
        text += fmt::format("  {} the same as an earlier one (equal id) and not computed twice\n",
                            outcome.repeated == 1
                                ? std::string{"1 configuration is"}
                                : reports::grouped(outcome.repeated) + " configurations are");
    }
    if (outcome.retired > 0) {
        text +=
            fmt::format("  {} of an earlier sweep stay in results.sqlite, not in the CSV files\n",
                        reports::counted(outcome.retired, "result"));
    }
    return text;
}

std::string plan_text(const scene::SweepSpace& space, const SweepSummary& summary)
{
    std::string text = fmt::format(
        "{}: {}\n", reports::counted(summary.configurations, "configuration"), axes_text(space));
    if (summary.refused > 0) {
        text += fmt::format("  {} of them will fail, the first as {}\n",
                            reports::grouped(summary.refused), summary.first_refusal);
    }
    text += fmt::format("  {}\n", counts_text(summary.counts));
    text += fmt::format("  roughly {} on two cores with software GL, and {} MiB of memory "
                        "beside the scene\n",
                        duration_text(summary.estimated_seconds),
                        reports::grouped((summary.estimated_bytes >> 20U) + 1));
    return text;
}

std::string plan_json(const SweepSummary& summary)
{
    const analysis::PlanCounts& counts = summary.counts;
    const nlohmann::ordered_json json{{"schema", 1},
                                      {"configurations", summary.configurations},
                                      {"refused", summary.refused},
                                      {"first_refusal", summary.first_refusal},
                                      {"plan",
                                       {{"configurations", counts.configurations},
                                        {"scenes", counts.scenes},
                                        {"truths", counts.truths},
                                        {"receiver_passes", counts.receiver_passes},
                                        {"shadow_maps", counts.shadow_maps},
                                        {"prefilters", counts.prefilters},
                                        {"lookup_passes", counts.lookup_passes},
                                        {"bias_curves", counts.curves}}},
                                      {"estimated_seconds", summary.estimated_seconds},
                                      {"estimated_bytes", summary.estimated_bytes}};
    return json.dump(2) + "\n";
}

} // namespace gnomon::cli
