#include "reports/gate/gate_report.hpp"
#include "reports/gate/gate_text.hpp"
#include "reports/page/page_html.hpp"
#include "reports/text/text.hpp"
#include "store/shell_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace gnomon::reports {

namespace {

using analysis::GateFinding;

constexpr std::size_t most_rows = 50;

/// "23,602 more false_shadow": the worst finding as a heading.
std::string worst_text(const GateReport& report)
{
    if (report.outcome.findings.empty()) {
        return report.verdict == analysis::GateVerdict::pass ? "Nothing is worse than the baseline"
                                                             : "Results are missing";
    }
    const GateFinding& worst = report.outcome.findings.front();
    const std::string& metric = report.rules[worst.rule].metric;
    std::string name = metric;
    std::ranges::replace(name, '_', ' ');
    return fmt::format("{}: {} → {}", name, metric_text(metric, worst.before),
                       metric_text(metric, worst.now));
}

/// The changed keys of the worst finding's job, and the cause that grew most.
std::string suspects(const GateReport& report)
{
    if (report.outcome.findings.empty()) {
        return {};
    }
    const GateFinding& worst = report.outcome.findings.front();
    const analysis::GatePair* const pair = report.outcome.pair_of(worst.entry);
    std::string html;
    if (pair != nullptr) {
        html +=
            pair->changes.empty()
                ? "<p>The job is unchanged: suspect the renderer, the driver or the scene.</p>\n"
                : fmt::format("<p>First suspects: <bdi>{}</bdi></p>\n",
                              escaped(suspects_text(pair->changes)));
    }
    if (const auto cause = cause_of_finding(report, worst)) {
        html += fmt::format("<p>Dominant cause: {}, {} pixels more.</p>\n", escaped(cause->name),
                            grouped_amount(cause->pixels));
    }
    return html;
}

std::string strip(const GateReport& report)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> captions{
        {{"Before", "wrong in the baseline"},
         {"After", "wrong now; the new ones coloured"},
         {"New", "<span class=\"false-shadow\">■</span> falsely shadowed "
                 "<span class=\"false-lit\">■</span> falsely lit"}}};
    if (report.panels.size() != captions.size()) {
        return {};
    }
    std::string html = "<div class=\"strip\">\n";
    for (std::size_t i = 0; i < captions.size(); ++i) {
        html += picture_figure(report.panels[i], captions[i].first, captions[i].second);
    }
    return html + "</div>\n";
}

/// The pixels that count, and the configuration if there are several.
std::string subject_of(const GateReport& report, const GateFinding& finding)
{
    const auto& entries = report.run.results.entries;
    const std::string part = filter_text(finding.filter);
    const std::string of = part.empty() ? "all pixels" : part;
    return entries.size() == 1
               ? of
               : fmt::format("{}: {}", store::key_text(entries[finding.entry].key), of);
}

std::string finding_row(const GateReport& report, const GateFinding& finding)
{
    const std::string& metric = report.rules[finding.rule].metric;
    const bool is_warning =
        analysis::severity_of(finding, report.rules) == analysis::Severity::warn;
    return fmt::format("<tr>{}<td><bdi>{}</bdi></td>{}{}{}<td>{}<bdi>{}</bdi></td></tr>\n",
                       row_heading(metric), escaped(subject_of(report, finding)),
                       number_cell(metric_text(metric, finding.before)),
                       number_cell(metric_text(metric, finding.now)),
                       number_cell(change_text(metric, finding.before, finding.now)),
                       is_warning ? "warning, " : "", escaped(broken_limit_text(report, finding)));
}

std::string findings_table(const GateReport& report)
{
    const auto& findings = report.outcome.findings;
    if (findings.empty()) {
        return {};
    }
    std::string html =
        "<div class=\"scroll\"><table><caption>Broken rules and warnings, worst "
        "first</caption>\n<thead><tr>"
        "<th scope=\"col\">metric</th><th scope=\"col\">of</th><th scope=\"col\" "
        "class=\"number\">baseline</th>"
        "<th scope=\"col\" class=\"number\">now</th><th scope=\"col\" class=\"number\">change</th>"
        "<th scope=\"col\">limit</th></tr></thead>\n<tbody>\n";
    for (std::size_t i = 0; i < std::min(findings.size(), most_rows); ++i) {
        html += finding_row(report, findings[i]);
    }
    html += table_end;
    return findings.size() <= most_rows
               ? html
               : html +
                     fmt::format("<p>{} more: <code>gnomon gate --verbose</code> lists them.</p>\n",
                                 grouped(findings.size() - most_rows));
}

/// The commands that show the worst configuration and accept the results.
std::string commands(const GateReport& report)
{
    std::string html;
    if (!report.outcome.findings.empty()) {
        const std::size_t entry = report.outcome.findings.front().entry;
        const std::string command =
            store::showing_command(report.run, report.run.results.entries[entry].key);
        html += command.empty()
                    ? std::string{}
                    : fmt::format("<p>See it:</p>\n<pre><code>{}</code></pre>\n", escaped(command));
    }
    const std::string accept =
        store::shell_text({"gnomon", "gate", report.run.folder.string(), "--baseline",
                           report.baseline_file.string(), "--update", "changed"});
    return html +
           fmt::format("<p>If the change is wanted, accept it:</p>\n<pre><code>{}</code></pre>"
                       "\n",
                       escaped(accept));
}

} // namespace

std::string gate_page(const GateReport& report)
{
    const bool is_pass = report.verdict == analysis::GateVerdict::pass;
    std::string body = fmt::format(
        "<body>\n<main>\n<section id=\"answer\" aria-labelledby=\"answer-heading\">\n"
        "<h1 id=\"answer-heading\"><span class=\"{}\">{}</span> {}</h1>\n<p class=\"lead\"><bdi>{}"
        "</bdi></p>\n",
        is_pass ? "good" : "bad", is_pass ? "Pass." : "Regression.", escaped(worst_text(report)),
        escaped(verdict_sentence(report)));
    body += suspects(report) + strip(report);
    for (const std::string& sentence : unfinished_sentences(report)) {
        body += fmt::format("<p><bdi>{}</bdi></p>\n", escaped(sentence));
    }
    body += findings_table(report) + "</section>\n<section>\n" + commands(report) +
            "</section>\n</main>\n</body>\n</html>\n";
    return plain_page(is_pass ? "Gate: pass" : "Gate: regression", body);
}

} // namespace gnomon::reports
