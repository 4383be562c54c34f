#include "reports/gate/gate_table.hpp"

#include "reports/gate/gate_names.hpp"
#include "reports/gate/gate_sentences.hpp"
#include "reports/words/text.hpp"
#include "scene/one_line.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace gnomon::reports {

namespace {

using analysis::GateFinding;

constexpr std::size_t most_configurations = 10;
constexpr std::size_t most_listed = 10;

std::string environment_lines(const GateReport& report)
{
    const analysis::Environment& before = report.baseline.environment;
    const analysis::Environment& now = report.run.results.environment;
    std::string text;
    if (!report.outcome.is_same_renderer) {
        text += fmt::format("  compared all the same (--allow-environment):\n"
                            "    baseline  {}\n    run       {}\n",
                            renderer_text(before), renderer_text(now));
    }
    if (report.run.has_several_environments) {
        text += "  the run's results come from several environments (--allow-environment)\n";
    }
    if (before.gnomon != now.gnomon) {
        text += fmt::format("  baseline of {}, run of {}\n", scene::one_line(before.gnomon),
                            scene::one_line(now.gnomon));
    }
    return text;
}

/// What of the job changed where nothing is found: its limits were those of changed jobs.
std::string changed_lines(const GateReport& report)
{
    std::string text;
    std::size_t more = 0;
    for (const analysis::GatePair& pair : report.outcome.pairs) {
        const bool is_found =
            std::any_of(report.outcome.findings.begin(), report.outcome.findings.end(),
                        [&](const GateFinding& finding) { return finding.entry == pair.now; });
        if (pair.changes.empty() || is_found) {
            continue;
        }
        if (text.empty()) {
            text = fmt::format("  the job changed: {}\n", suspects_text(pair.changes));
        } else {
            ++more;
        }
    }
    return text + (more > 0 ? fmt::format("  and of {} more\n", counted(more, "configuration"))
                            : std::string{});
}

/// "  false_shadow    1,234    2,345    +1,111  at most +0: rule false_shadow".
std::string finding_line(const GateReport& report, const GateFinding& finding)
{
    const analysis::GateRule& rule = report.rules[finding.rule];
    const std::string part = filter_text(finding.filter);
    const bool is_warning =
        analysis::severity_of(finding, report.rules) == analysis::Severity::warn;
    std::string line =
        fmt::format("  {} {} {} {}  {}{}: {}\n", pad_right(rule.metric, 34),
                    pad_left(metric_text(rule.metric, finding.before), 12),
                    pad_left(metric_text(rule.metric, finding.now), 12),
                    pad_left(change_text(rule.metric, finding.before, finding.now), 12),
                    is_warning ? "warning, " : "", broken_limit_text(report, finding), rule.id);
    if (!part.empty()) {
        line += fmt::format("    of {}\n", part);
    }
    if (finding.new_pixels && finding.new_pixels->count > 0) {
        line += fmt::format("    {}\n", new_pixels_text(*finding.new_pixels));
    }
    if (const std::string picture = picture_of(report, finding); !picture.empty()) {
        line += fmt::format("    picture: {}\n", scene::one_line(picture));
    }
    return line;
}

/// One configuration with its findings.
std::string configuration_block(const GateReport& report, std::size_t entry)
{
    const analysis::ConfigurationKey& key = report.run.results.entries[entry].key;
    std::string text =
        fmt::format("\n{}\n  {} {} {} {}\n", store::key_text(key), pad_right("metric", 34),
                    pad_left("baseline", 12), pad_left("now", 12), pad_left("change", 12));
    std::string cause_line; // of the worst that has a cause
    for (const GateFinding& finding : report.outcome.findings) {
        if (finding.entry == entry) {
            text += finding_line(report, finding);
            const auto cause =
                cause_line.empty() ? cause_of_finding(report, finding) : std::nullopt;
            cause_line =
                cause ? fmt::format("  dominant cause: {}, {} more\n", cause->name,
                                    counted(static_cast<std::uint64_t>(cause->pixels), "pixel"))
                      : cause_line;
        }
    }
    text += cause_line;
    if (const analysis::GatePair* const pair = report.outcome.pair_of(entry)) {
        if (!pair->changes.empty()) {
            text += fmt::format("  first suspects: {}\n", suspects_text(pair->changes));
        }
    }
    if (const std::string command = store::showing_command(report.run, key); !command.empty()) {
        text += fmt::format("  see it: {}\n", scene::one_line(command));
    }
    return text;
}

std::string configuration_blocks(const GateReport& report)
{
    std::vector<std::size_t> order; // by their worst finding
    for (const GateFinding& finding : report.outcome.findings) {
        if (std::find(order.begin(), order.end(), finding.entry) == order.end()) {
            order.push_back(finding.entry);
        }
        if (order.size() > most_configurations) {
            break;
        }
    }
    std::string text;
    for (std::size_t i = 0; i < std::min(order.size(), most_configurations); ++i) {
        text += configuration_block(report, order[i]);
    }
    if (order.size() > most_configurations) {
        text += "\nand more configurations: --json has all of them\n";
    }
    return text;
}

std::string key_lines(std::string_view title, const std::vector<std::size_t>& indices,
                      const analysis::GateEntries& entries)
{
    if (indices.empty()) {
        return {};
    }
    std::string text = fmt::format("\n{} {}\n", counted(indices.size(), "configuration"), title);
    for (std::size_t i = 0; i < std::min(indices.size(), most_listed); ++i) {
        text += fmt::format("  {}\n", store::key_text(entries.entries[indices[i]].key));
    }
    if (indices.size() > most_listed) {
        text += fmt::format("  and {} more\n", grouped(indices.size() - most_listed));
    }
    return text;
}

std::string improvement_lines(const GateReport& report)
{
    const auto& improvements = report.outcome.improvements;
    if (improvements.empty()) {
        return {};
    }
    std::string text =
        fmt::format("\n{} better than in the baseline\n", counted(improvements.size(), "value"));
    for (std::size_t i = 0; i < std::min(improvements.size(), most_listed); ++i) {
        const analysis::GateImprovement& one = improvements[i];
        text += fmt::format("  {} {} {} {}  {}\n", pad_right(one.metric, 34),
                            pad_left(metric_text(one.metric, one.before), 12),
                            pad_left(metric_text(one.metric, one.now), 12),
                            pad_left(change_text(one.metric, one.before, one.now), 12),
                            store::key_text(report.run.results.entries[one.entry].key));
    }
    if (improvements.size() > most_listed) {
        text += fmt::format("  and {} more\n", grouped(improvements.size() - most_listed));
    }
    return text;
}

} // namespace

std::string gate_table(const GateReport& report)
{
    std::string unfinished;
    for (const std::string& line : unfinished_sentences(report)) {
        unfinished += fmt::format("  {}\n", line);
    }
    return verdict_sentence(report) + '\n' + environment_lines(report) + changed_lines(report) +
           unfinished + configuration_blocks(report) +
           key_lines("of the baseline that the run lacks", report.outcome.missing,
                     report.baseline) +
           key_lines("of the run that the baseline lacks", report.outcome.added,
                     report.run.results) +
           improvement_lines(report);
}

} // namespace gnomon::reports
