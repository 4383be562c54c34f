#include "reports/gate/gate_report.hpp"

#include "reports/gate/gate_text.hpp"
#include "reports/text/text.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace gnomon::reports {

namespace {

using analysis::GateFinding;

constexpr std::size_t most_configurations = 10;
constexpr std::size_t most_listed = 10;
constexpr std::size_t most_brief_findings = 2;

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

/// Jobs that changed without a finding, because their rules allow changed jobs.
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
    return text +
           (more > 0 ? fmt::format("  and so did {}\n", counted(more, "more job")) : std::string{});
}

/// "  false_shadow    1,234    2,345    +1,111  at most +0: rule false_shadow".
std::string finding_line(const GateReport& report, const GateFinding& finding)
{
    const analysis::GateRule& rule = report.rules[finding.rule];
    const bool is_warning =
        analysis::severity_of(finding, report.rules) == analysis::Severity::warn;
    return fmt::format("  {} {} {} {}  {}{}: {}", pad_right(rule.metric, 34),
                       pad_left(metric_text(rule.metric, finding.before), 12),
                       pad_left(metric_text(rule.metric, finding.now), 12),
                       pad_left(change_text(rule.metric, finding.before, finding.now), 12),
                       is_warning ? "warning, " : "", broken_limit_text(report, finding), rule.id);
}

std::string picture_line(const GateReport& report, const GateFinding& finding)
{
    const std::string picture = picture_of(report, finding);
    return picture.empty() ? std::string{}
                           : fmt::format("    picture: {}\n", scene::one_line(picture));
}

/// A finding's pixel filter, new pixels and picture.
std::string finding_details(const GateReport& report, const GateFinding& finding)
{
    std::string lines;
    if (const std::string part = filter_text(finding.filter); !part.empty()) {
        lines += fmt::format("    of {}\n", part);
    }
    if (finding.new_pixels && finding.new_pixels->count > 0) {
        lines += fmt::format("    {}\n", new_pixels_text(*finding.new_pixels));
    }
    return lines + picture_line(report, finding);
}

/// The changes of a configuration's job; may be empty.
std::string suspects_line(const GateReport& report, std::size_t entry)
{
    const analysis::GatePair* const pair = report.outcome.pair_of(entry);
    return pair == nullptr || pair->changes.empty()
               ? std::string{}
               : fmt::format("  first suspects: {}\n", suspects_text(pair->changes));
}

/// The cause of a configuration's worst finding that has one; may be empty.
std::string cause_line(const GateReport& report, std::size_t entry)
{
    for (const GateFinding& finding : report.outcome.findings) {
        const auto cause =
            finding.entry == entry ? cause_of_finding(report, finding) : std::nullopt;
        if (cause) {
            return fmt::format("  dominant cause: {}, {} px more\n", cause->name,
                               grouped_amount(cause->pixels));
        }
    }
    return {};
}

std::string command_line(const GateReport& report, std::size_t entry)
{
    const std::string command =
        store::showing_command(report.run, report.run.results.entries[entry].key);
    return command.empty() ? std::string{}
                           : fmt::format("  see it: {}\n", scene::one_line(command));
}

std::string finding_heading()
{
    return fmt::format("  {} {} {} {}\n", pad_right("metric", 34), pad_left("baseline", 12),
                       pad_left("now", 12), pad_left("change", 12));
}

/// One configuration: its job's changes, then its findings.
std::string configuration_block(const GateReport& report, std::size_t entry)
{
    std::string text =
        fmt::format("\n{}\n", store::key_text(report.run.results.entries[entry].key)) +
        suspects_line(report, entry) + cause_line(report, entry) + command_line(report, entry) +
        finding_heading();
    for (const GateFinding& finding : report.outcome.findings) {
        if (finding.entry == entry) {
            text += finding_line(report, finding) + "\n" + finding_details(report, finding);
        }
    }
    return text;
}

/// The worst configuration in a few lines: its job's changes, its worst findings, a picture.
std::string worst_configuration(const GateReport& report)
{
    const auto& findings = report.outcome.findings;
    if (findings.empty()) {
        return {};
    }
    const std::size_t entry = findings.front().entry;
    const auto& entries = report.run.results.entries;
    std::string text = entries.size() == 1
                           ? std::string{}
                           : fmt::format("worst: {}\n", store::key_text(entries[entry].key));
    text += suspects_line(report, entry) + cause_line(report, entry);
    text += finding_heading();
    std::string picture;
    std::size_t shown = 0;
    for (const GateFinding& finding : findings) {
        if (finding.entry == entry && shown < most_brief_findings) {
            const std::string part = filter_text(finding.filter);
            text += fmt::format("{}{}{}\n", finding_line(report, finding),
                                part.empty() ? "" : ", of ", part);
            ++shown;
        }
        picture =
            picture.empty() && finding.entry == entry ? picture_line(report, finding) : picture;
    }
    text += picture + command_line(report, entry);
    if (findings.size() > shown) {
        text += fmt::format("  and {}: --verbose lists them\n",
                            counted(findings.size() - shown, "more finding"));
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

std::string key_heading(std::string_view title, const std::vector<std::size_t>& indices)
{
    return indices.empty()
               ? std::string{}
               : fmt::format("{} {}\n", counted(indices.size(), "configuration"), title);
}

std::string key_lines(std::string_view title, const std::vector<std::size_t>& indices,
                      const analysis::GateEntries& entries)
{
    if (indices.empty()) {
        return {};
    }
    std::string text = "\n" + key_heading(title, indices);
    for (std::size_t i = 0; i < std::min(indices.size(), most_listed); ++i) {
        text += fmt::format("  {}\n", store::key_text(entries.entries[indices[i]].key));
    }
    if (indices.size() > most_listed) {
        text += fmt::format("  and {} more\n", grouped(indices.size() - most_listed));
    }
    return text;
}

std::string improvement_heading(const GateReport& report)
{
    const std::size_t count = report.outcome.improvements.size();
    return count == 0 ? std::string{}
                      : fmt::format("{} better than in the baseline\n", counted(count, "value"));
}

std::string improvement_lines(const GateReport& report)
{
    const auto& improvements = report.outcome.improvements;
    if (improvements.empty()) {
        return {};
    }
    std::string text = "\n" + improvement_heading(report);
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

constexpr std::string_view missing_title = "of the baseline that the run lacks";
constexpr std::string_view added_title = "of the run that the baseline lacks";

} // namespace

std::string gate_table(const GateReport& report, GateDetail detail)
{
    std::string text = verdict_sentence(report) + '\n';
    std::string unfinished;
    for (const std::string& line : unfinished_sentences(report)) {
        unfinished += fmt::format("  {}\n", line);
    }
    if (detail == GateDetail::worst) {
        return text + environment_lines(report) + changed_lines(report) + unfinished +
               worst_configuration(report) + key_heading(missing_title, report.outcome.missing) +
               key_heading(added_title, report.outcome.added) + improvement_heading(report);
    }
    return text + environment_lines(report) + changed_lines(report) + unfinished +
           configuration_blocks(report) +
           key_lines(missing_title, report.outcome.missing, report.baseline) +
           key_lines(added_title, report.outcome.added, report.run.results) +
           improvement_lines(report);
}

} // namespace gnomon::reports
