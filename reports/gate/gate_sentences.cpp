#include "reports/gate/gate_sentences.hpp"

#include "reports/gate/gate_names.hpp"
#include "reports/text/text.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gnomon::reports {

namespace {

using analysis::GateVerdict;

constexpr std::size_t most_suspects = 10;

std::string rules_text(std::size_t count, std::string_view what)
{
    return fmt::format("{} {}", counted(count, "rule"), what);
}

/// How many pixels must be scored: `min`, or what the baseline's may fall to.
std::string nothing_tested_text(const analysis::GateRule& rule,
                                const analysis::GateFinding& finding)
{
    const bool is_below_min = rule.min && finding.limit == rule.min;
    const double least = is_below_min
                             ? *rule.min
                             : std::ceil(finding.before.value_or(0) - finding.limit.value_or(0));
    return fmt::format("nothing is tested: at least {} needed", metric_text(rule.metric, least));
}

} // namespace

std::string verdict_sentence(const GateReport& report)
{
    const std::size_t failed = report.outcome.broken(report.rules, analysis::Severity::fail);
    const std::size_t warned = report.outcome.broken(report.rules, analysis::Severity::warn);
    std::string_view word = "pass";
    if (report.verdict == GateVerdict::regression) {
        word = "REGRESSION";
    } else if (report.verdict == GateVerdict::incomplete) {
        word = "INCOMPLETE";
    }
    std::string line = fmt::format(
        "{}: {} compared with {}: {}", word, counted(report.outcome.pairs.size(), "configuration"),
        scene::one_line(report.baseline_file.string()), rules_text(failed, "broken"));
    if (warned > 0) {
        line += fmt::format(", {}", counted(warned, "warning"));
    }
    return line;
}

std::string broken_limit_text(const GateReport& report, const analysis::GateFinding& finding)
{
    const std::string limit = metric_text(report.rules[finding.rule].metric, finding.limit);
    switch (finding.reason) {
    case analysis::GateReason::above_max:
        return fmt::format("max {}", limit);
    case analysis::GateReason::below_min:
        return fmt::format("min {}", limit);
    case analysis::GateReason::worse_than_baseline:
        return fmt::format("{} allowed", limit);
    case analysis::GateReason::nothing_tested:
        return nothing_tested_text(report.rules[finding.rule], finding);
    case analysis::GateReason::traded_off:
        return fmt::format("{} allowed, traded for {}", limit,
                           analysis::is_amount(report.rules[finding.rule].metric)
                               ? "less error by amount"
                               : "fewer wrong pixels");
    case analysis::GateReason::not_available:
        break;
    }
    return finding.obstacle.empty() ? "not available" : finding.obstacle;
}

std::string finding_sentence(const GateReport& report, const analysis::GateFinding& finding)
{
    const analysis::GateRule& rule = report.rules[finding.rule];
    std::string text =
        fmt::format("{} {} -> {}", rule.metric, metric_text(rule.metric, finding.before),
                    metric_text(rule.metric, finding.now));
    if (const std::string change = change_text(rule.metric, finding.before, finding.now);
        !change.empty()) {
        text += fmt::format(" ({})", change);
    }
    text += fmt::format(", {}", broken_limit_text(report, finding));
    if (const std::string part = filter_text(finding.filter); !part.empty()) {
        text += fmt::format(", of {}", part);
    }
    return text + fmt::format("; rule \"{}\"", rule.id);
}

std::string new_pixels_text(const analysis::NewPixels& pixels)
{
    constexpr std::size_t most_shown = 4;
    std::string text;
    const std::size_t shown = std::min(pixels.first.size(), most_shown);
    for (std::size_t i = 0; i < shown; ++i) {
        text +=
            fmt::format("{}({}, {})", i == 0 ? "at " : ", ", pixels.first[i].x, pixels.first[i].y);
    }
    if (pixels.count > shown) {
        text +=
            fmt::format(" and {} more, from ({}, {}) to ({}, {})", grouped(pixels.count - shown),
                        pixels.lower.x, pixels.lower.y, pixels.upper.x, pixels.upper.y);
    }
    if (pixels.cause) {
        text += fmt::format("; {} by {}", grouped(static_cast<std::uint64_t>(pixels.cause->pixels)),
                            pixels.cause->name);
    }
    return text;
}

std::string suspects_text(const std::vector<analysis::ParameterChange>& changes)
{
    std::string text;
    for (std::size_t i = 0; i < std::min(changes.size(), most_suspects); ++i) {
        text += fmt::format("{}{}", i == 0 ? "" : "; ", change_line(changes[i]));
    }
    if (changes.size() > most_suspects) {
        text += fmt::format("; and {} more", grouped(changes.size() - most_suspects));
    }
    return text;
}

std::vector<std::string> unfinished_sentences(const GateReport& report)
{
    const store::RunStatus& status = report.run.status;
    std::vector<std::string> lines;
    if (!status.is_complete()) {
        lines.push_back(fmt::format(
            "the run is not complete: {} failed, {} missing; `gnomon status` lists them",
            grouped(status.failed), grouped(status.missing)));
    }
    if (report.outcome.pairs.empty()) {
        lines.emplace_back("the baseline and the run have no configuration in common: are they of "
                           "the same sweep?");
    }
    for (const std::size_t rule : report.outcome.unmatched_rules) {
        lines.push_back(fmt::format("rule {} matches nothing", report.rules[rule].id));
    }
    return lines;
}

} // namespace gnomon::reports
