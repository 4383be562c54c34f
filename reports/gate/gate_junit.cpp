#include "reports/gate/gate_report.hpp"

#include "reports/gate/gate_text.hpp"
#include "store/csv/csv_text.hpp"

#include <fmt/format.h>

#include <map>
#include <vector>

namespace gnomon::reports {

namespace {

using analysis::GateFinding;

/// A test case; passed if `type` is empty.
struct JunitCase {
    std::string name;
    std::string element; ///< "failure" or "error"
    std::string type;
    std::string message;
    std::string text;
};

std::string case_element(const JunitCase& one)
{
    const std::string start = fmt::format("    <testcase classname=\"gnomon.gate\" name=\"{}\" "
                                          "time=\"0\"",
                                          xml_text(one.name));
    if (one.type.empty()) {
        return start + "/>\n";
    }
    return fmt::format("{}>\n      <{} type=\"{}\" message=\"{}\">{}</{}>\n    </testcase>\n",
                       start, one.element, one.type, xml_text(one.message), xml_text(one.text),
                       one.element);
}

/// The findings of failed rules, by the run's entries.
std::map<std::size_t, std::vector<const GateFinding*>> failing_findings(const GateReport& report)
{
    std::map<std::size_t, std::vector<const GateFinding*>> found;
    for (const GateFinding& finding : report.outcome.findings) {
        if (analysis::severity_of(finding, report.rules) == analysis::Severity::fail) {
            found[finding.entry].push_back(&finding);
        }
    }
    return found;
}

JunitCase judged_case(const GateReport& report, std::size_t entry,
                      const std::vector<const GateFinding*>& findings)
{
    const analysis::ConfigurationKey& key = report.run.results.entries[entry].key;
    JunitCase one{store::key_text(key), {}, {}, {}, {}};
    if (findings.empty()) {
        return one;
    }
    const GateFinding& worst = *findings.front();
    const bool is_unknown = worst.reason == analysis::GateReason::not_available;
    one.element = is_unknown ? "error" : "failure";
    one.type = reason_code(worst.reason);
    one.message = finding_sentence(report, worst);
    for (const GateFinding* finding : findings) {
        one.text += finding_sentence(report, *finding) + '\n';
    }
    if (const auto cause = cause_of_finding(report, worst)) {
        one.text += fmt::format("dominant cause: {}\n", cause->name);
    }
    const analysis::GatePair* const pair = report.outcome.pair_of(entry);
    if (pair != nullptr && !pair->changes.empty()) {
        one.text += fmt::format("first suspects: {}\n", suspects_text(pair->changes));
    }
    if (const std::string command = store::showing_command(report.run, key); !command.empty()) {
        one.text += fmt::format("see it: {}\n", command);
    }
    return one;
}

std::vector<JunitCase> junit_cases(const GateReport& report)
{
    std::vector<JunitCase> cases;
    JunitCase whole{"the run is complete", {}, {}, {}, {}};
    if (const auto reasons = unfinished_sentences(report); !reasons.empty()) {
        whole.element = "error";
        whole.type = "incomplete";
        whole.message = reasons.front();
        for (const std::string& reason : reasons) {
            whole.text += reason + '\n';
        }
    }
    cases.push_back(std::move(whole));
    auto findings = failing_findings(report);
    for (std::size_t entry = 0; entry < report.run.results.entries.size(); ++entry) {
        cases.push_back(judged_case(report, entry, findings[entry]));
    }
    for (const std::size_t entry : report.outcome.missing) {
        const std::string missing = "the run lacks this configuration of the baseline";
        cases.push_back({store::key_text(report.baseline.entries[entry].key), "error", "missing",
                         missing, missing});
    }
    return cases;
}

std::string junit_notes(const GateReport& report)
{
    std::string text = verdict_sentence(report) + '\n';
    for (const GateFinding& finding : report.outcome.findings) {
        if (analysis::severity_of(finding, report.rules) == analysis::Severity::warn) {
            text += fmt::format("warning: {}: {}\n",
                                store::key_text(report.run.results.entries[finding.entry].key),
                                finding_sentence(report, finding));
        }
    }
    for (const analysis::GateImprovement& one : report.outcome.improvements) {
        text += fmt::format("better: {}: {} {} -> {}\n",
                            store::key_text(report.run.results.entries[one.entry].key), one.metric,
                            metric_text(one.metric, one.before), metric_text(one.metric, one.now));
    }
    return text;
}

std::string property_element(std::string_view name, std::string_view value)
{
    return fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", name, xml_text(value));
}

std::string document(const std::vector<JunitCase>& all, std::string_view properties,
                     std::string_view notes)
{
    std::string cases;
    std::size_t failures = 0;
    std::size_t errors = 0;
    for (const JunitCase& one : all) {
        cases += case_element(one);
        failures += one.element == "failure" ? 1U : 0U;
        errors += one.element == "error" ? 1U : 0U;
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "  <testsuite id=\"0\" package=\"gnomon\" name=\"gate\" tests=\"{}\" failures=\"{}\" "
        "errors=\"{}\" time=\"0\" timestamp=\"1970-01-01T00:00:00\" hostname=\"localhost\">\n"
        "    <properties>\n{}    </properties>\n{}"
        "    <system-out>{}</system-out>\n    <system-err></system-err>\n"
        "  </testsuite>\n</testsuites>\n",
        all.size(), failures, errors, properties, cases, xml_text(notes));
}

} // namespace

std::string xml_text(std::string_view text)
{
    const std::string readable = store::readable_text(text);
    std::string escaped;
    for (std::size_t i = 0; i < readable.size(); ++i) {
        const char c = readable[i];
        const std::string_view rest = std::string_view{readable}.substr(i, 3);
        if (rest == "\xEF\xBF\xBE" || rest == "\xEF\xBF\xBF") { // U+FFFE and U+FFFF
            escaped += "\xEF\xBF\xBD";
            i += 2;
        } else if (c == '&' || c == '<' || c == '>' || c == '"' ||
                   static_cast<unsigned char>(c) < 0x20) {
            escaped += fmt::format("&#{};", static_cast<int>(c));
        } else {
            escaped += c;
        }
    }
    return escaped;
}

std::string gate_junit(const GateReport& report)
{
    return document(
        junit_cases(report),
        property_element("baseline", report.baseline_file.string()) +
            property_element("baseline renderer", renderer_text(report.baseline.environment)) +
            property_element("run renderer", renderer_text(report.run.results.environment)),
        junit_notes(report));
}

std::string gate_junit_refusal(std::string_view baseline_file, std::string_view problem)
{
    const std::string text{problem};
    return document({{"the run can be compared", "error", "not_comparable", text, text}},
                    property_element("baseline", baseline_file), text);
}

} // namespace gnomon::reports
