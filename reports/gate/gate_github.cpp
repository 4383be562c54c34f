#include "reports/gate/gate_report.hpp"

#include "reports/gate/gate_text.hpp"
#include "reports/text/text.hpp"
#include "store/csv/csv_text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::reports {

namespace {

using analysis::GateFinding;

constexpr std::size_t most_annotations = 10;

/// Escapes the given bytes as `%XX`.
std::string percent_escaped(std::string_view text, std::string_view bytes)
{
    std::string escaped;
    for (const char c : store::readable_text(text)) {
        if (bytes.find(c) == std::string_view::npos) {
            escaped += c;
        } else {
            escaped += fmt::format("%{:02X}", static_cast<unsigned>(c));
        }
    }
    return escaped;
}

std::string annotation(std::string_view level, const std::string& title, const std::string& text)
{
    return fmt::format("::{} title={}::{}\n", level, github_property(title), github_message(text));
}

std::string annotation_of(const GateReport& report, const GateFinding& finding)
{
    const bool is_warning =
        analysis::severity_of(finding, report.rules) == analysis::Severity::warn;
    const analysis::ConfigurationKey& key = report.run.results.entries[finding.entry].key;
    std::string text = finding_sentence(report, finding);
    if (const auto cause = cause_of_finding(report, finding)) {
        text += fmt::format("\ndominant cause: {}", cause->name);
    }
    const analysis::GatePair* const pair = report.outcome.pair_of(finding.entry);
    if (pair != nullptr && !pair->changes.empty()) {
        text += fmt::format("\nfirst suspects: {}", suspects_text(pair->changes));
    }
    if (const std::string command = store::showing_command(report.run, key); !command.empty()) {
        text += fmt::format("\nsee it: {}", command);
    }
    return annotation(is_warning ? "warning" : "error",
                      fmt::format("gnomon gate, {}", store::key_text(key)), text);
}

std::string summary_row(const GateReport& report, const GateFinding& finding)
{
    const analysis::GateRule& rule = report.rules[finding.rule];
    const auto cause = cause_of_finding(report, finding);
    const std::string part = filter_text(finding.filter);
    return fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} |\n",
        analysis::severity_of(finding, report.rules) == analysis::Severity::warn ? "warning"
                                                                                 : "**fail**",
        markdown_cell(store::key_text(report.run.results.entries[finding.entry].key)),
        markdown_cell(part.empty() ? rule.metric : fmt::format("{}, {}", rule.metric, part)),
        metric_text(rule.metric, finding.before), metric_text(rule.metric, finding.now),
        markdown_cell(broken_limit_text(report, finding)), cause ? cause->name : "",
        markdown_cell(rule.id));
}

/// The job changes of the worst finding; may be empty.
std::string first_suspects(const GateReport& report)
{
    const auto& findings = report.outcome.findings;
    const analysis::GatePair* const pair =
        findings.empty() ? nullptr : report.outcome.pair_of(findings.front().entry);
    return pair == nullptr || pair->changes.empty()
               ? std::string{}
               : fmt::format("First suspects: {}\n", markdown_cell(suspects_text(pair->changes)));
}

/// The text after the findings.
std::string summary_end(const GateReport& report, std::size_t left_out)
{
    std::string text;
    if (left_out > 0) {
        text += fmt::format("\n{} left out here: `gnomon gate --json` has them.\n",
                            counted(left_out, "finding"));
    }
    const analysis::GateOutcome& outcome = report.outcome;
    text += fmt::format("\n{} better than in the baseline, {} of the run missing, {} new.\n",
                        counted(outcome.improvements.size(), "value"),
                        counted(outcome.missing.size(), "configuration"),
                        grouped(outcome.added.size()));
    return text;
}

} // namespace

std::string github_message(std::string_view text)
{
    return percent_escaped(text, "%\r\n");
}

std::string github_property(std::string_view text)
{
    return percent_escaped(text, "%\r\n:,");
}

std::string markdown_cell(std::string_view text)
{
    std::string escaped;
    for (const char c : store::readable_text(text)) {
        if (c == '\n' || c == '\r' || c == '\t') {
            escaped += ' ';
        } else if (c == '<') {
            escaped += "&lt;";
        } else if (c == '&') {
            escaped += "&amp;";
        } else {
            if (std::string_view{"\\`*_[]|~@#!"}.find(c) != std::string_view::npos) {
                escaped += '\\';
            }
            escaped += c;
        }
    }
    return escaped;
}

std::string github_annotations(const GateReport& report)
{
    std::string text;
    for (const std::string& reason : unfinished_sentences(report)) {
        text += annotation("error", "gnomon gate", reason);
    }
    const auto& findings = report.outcome.findings;
    for (std::size_t i = 0; i < std::min(findings.size(), most_annotations); ++i) {
        text += annotation_of(report, findings[i]);
    }
    return text;
}

std::string github_summary(const GateReport& report, std::size_t most_bytes)
{
    constexpr std::size_t end_bytes = 512; // more than `summary_end` needs
    std::string text =
        fmt::format("### gnomon gate\n\n{}\n\n", markdown_cell(verdict_sentence(report)));
    for (const std::string& reason : unfinished_sentences(report)) {
        text += fmt::format("- {}\n", markdown_cell(reason));
    }
    const auto& findings = report.outcome.findings;
    text += first_suspects(report);
    if (!findings.empty()) {
        text += "\n| | configuration | metric | baseline | now | limit | cause | rule |\n"
                "|---|---|---|---:|---:|---|---|---|\n";
    }
    std::size_t shown = 0;
    for (; shown < findings.size(); ++shown) {
        const std::string row = summary_row(report, findings[shown]);
        if (text.size() + row.size() + end_bytes > most_bytes) {
            break;
        }
        text += row;
    }
    text += summary_end(report, findings.size() - shown);
    return text.size() <= most_bytes ? text : std::string{};
}

} // namespace gnomon::reports
