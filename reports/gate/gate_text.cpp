#include "reports/gate/gate_text.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "reports/text/text.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace gnomon::reports {

namespace {

std::string number_text(std::string_view metric, double value)
{
    return analysis::is_whole_metric(metric) ? grouped(static_cast<std::uint64_t>(value))
                                             : fmt::format("{:.6g}", value);
}

} // namespace

std::string filter_text(const analysis::PixelFilter& filter)
{
    std::string text;
    const auto add = [&](std::string_view name, std::string_view value) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
    };
    if (filter.object) {
        add("object", *filter.object);
    }
    if (filter.cause) {
        add("cause", analysis::cause_names[static_cast<std::size_t>(*filter.cause)]);
    }
    if (filter.label) {
        add("label", analysis::label_names[static_cast<std::size_t>(*filter.label)]);
    }
    if (filter.bands) {
        const auto& [first, last] = *filter.bands;
        add("zeta_band", fmt::format("[{}, {}) m", first.lower_m(), last.upper_m()));
    }
    return scene::one_line(text);
}

store::Json filter_json(const analysis::PixelFilter& filter)
{
    store::Json json = store::Json::object();
    if (filter.object) {
        json["object"] = *filter.object;
    }
    if (filter.cause) {
        json["cause"] = analysis::cause_names[static_cast<std::size_t>(*filter.cause)];
    }
    if (filter.label) {
        json["label"] = analysis::label_names[static_cast<std::size_t>(*filter.label)];
    }
    if (filter.bands) {
        const auto finite = [](double end_m) {
            return std::isfinite(end_m) ? store::Json(end_m) : store::Json(nullptr);
        };
        json["zeta_band"] = {finite(filter.bands->first.lower_m()),
                             finite(filter.bands->last.upper_m())};
    }
    return json;
}

std::string metric_text(std::string_view metric, const std::optional<double>& value)
{
    return value ? number_text(metric, *value) : "-";
}

std::string change_text(std::string_view metric, const std::optional<double>& before,
                        const std::optional<double>& now)
{
    if (!before || !now) {
        return {};
    }
    const double change = *now - *before;
    return fmt::format("{}{}", change < 0 ? '-' : '+', number_text(metric, std::abs(change)));
}

std::string change_line(const analysis::ParameterChange& change)
{
    return scene::one_line(fmt::format("{}: {} -> {}", change.key, change.before.value_or("none"),
                                       change.now.value_or("none")));
}

std::string renderer_text(const analysis::Environment& environment)
{
    return scene::one_line(fmt::format("{}, {}, {}", environment.gl_renderer,
                                       environment.gl_version, environment.embree));
}

std::string_view reason_code(analysis::GateReason reason)
{
    switch (reason) {
    case analysis::GateReason::above_max:
        return "above_max";
    case analysis::GateReason::below_min:
        return "below_min";
    case analysis::GateReason::worse_than_baseline:
        return "worse_than_baseline";
    case analysis::GateReason::nothing_tested:
        return "nothing_tested";
    case analysis::GateReason::traded_off:
        return "traded_off";
    case analysis::GateReason::not_available:
        break;
    }
    return "not_available";
}

namespace {

using analysis::GateVerdict;

constexpr std::size_t most_suspects = 10;

std::string rules_text(std::size_t count, std::string_view what)
{
    return fmt::format("{} {}", counted(count, "rule"), what);
}

/// The smallest number of scored pixels: `min`, or the baseline's less the allowance.
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

std::string picture_of(const GateReport& report, const analysis::GateFinding& finding)
{
    const auto found =
        report.pictures.find(static_cast<std::size_t>(&finding - report.outcome.findings.data()));
    return found == report.pictures.end() ? std::string{} : found->second.string();
}

std::optional<analysis::DominantCause> cause_of_finding(const GateReport& report,
                                                        const analysis::GateFinding& finding)
{
    if (finding.cause) {
        return finding.cause;
    }
    const analysis::GatePair* const pair = report.outcome.pair_of(finding.entry);
    return pair == nullptr ? std::nullopt : pair->cause;
}

} // namespace gnomon::reports
