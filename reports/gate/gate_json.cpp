#include "reports/gate/gate_report.hpp"

#include "reports/gate/gate_text.hpp"
#include "store/json_values.hpp"

#include <string_view>

namespace gnomon::reports {

namespace {

std::string_view verdict_name(analysis::GateVerdict verdict)
{
    switch (verdict) {
    case analysis::GateVerdict::pass:
        return "pass";
    case analysis::GateVerdict::regression:
        return "regression";
    case analysis::GateVerdict::incomplete:
        break;
    }
    return "incomplete";
}

store::Json environment_json(const analysis::Environment& environment)
{
    return {{"gl_renderer", environment.gl_renderer},
            {"gl_version", environment.gl_version},
            {"embree", environment.embree},
            {"gnomon", environment.gnomon}};
}

store::Json text_or_null(const std::optional<std::string>& text)
{
    return text ? store::Json(*text) : store::Json(nullptr);
}

store::Json changes_json(const std::vector<analysis::ParameterChange>& changes)
{
    store::Json json = store::Json::array();
    for (const analysis::ParameterChange& change : changes) {
        json.push_back({{"key", change.key},
                        {"baseline", text_or_null(change.before)},
                        {"now", text_or_null(change.now)}});
    }
    return json;
}

store::Json pixels_json(const analysis::NewPixels& pixels)
{
    if (pixels.count == 0) {
        return nullptr;
    }
    store::Json first = store::Json::array();
    for (const analysis::PixelPlace& place : pixels.first) {
        first.push_back({place.x, place.y});
    }
    return {{"first", std::move(first)},
            {"box", {pixels.lower.x, pixels.lower.y, pixels.upper.x, pixels.upper.y}}};
}

store::Json finding_json(const GateReport& report, const analysis::GateFinding& finding)
{
    const analysis::GateRule& rule = report.rules[finding.rule];
    const analysis::ConfigurationKey& key = report.run.results.entries[finding.entry].key;
    const analysis::GatePair* const pair = report.outcome.pair_of(finding.entry);
    store::Json json{
        {"rule", rule.id},
        {"severity", analysis::severity_of(finding, report.rules) == analysis::Severity::fail
                         ? "fail"
                         : "warn"},
        {"reason", reason_code(finding.reason)},
        {"configuration", store::key_json(key)},
        {"metric", rule.metric},
        {"baseline", store::metric_json(rule.metric, finding.before)},
        {"now", store::metric_json(rule.metric, finding.now)},
        {"limit", store::number_or_null(finding.limit)}};
    const auto cause = cause_of_finding(report, finding);
    json["dominant_cause"] = cause ? store::Json(cause->name) : store::Json(nullptr);
    json["changed_parameters"] =
        pair != nullptr ? changes_json(pair->changes) : store::Json::array();
    json["command"] = store::showing_command(report.run, key);
    json["where"] = filter_json(finding.filter);
    json["obstacle"] =
        finding.obstacle.empty() ? store::Json(nullptr) : store::Json(finding.obstacle);
    json["pixels"] = finding.new_pixels ? pixels_json(*finding.new_pixels) : store::Json(nullptr);
    const std::string picture = picture_of(report, finding);
    json["picture"] = picture.empty() ? store::Json(nullptr) : store::Json(picture);
    return json;
}

/// The configurations whose job changed.
store::Json changed_json(const GateReport& report)
{
    store::Json json = store::Json::array();
    for (const analysis::GatePair& pair : report.outcome.pairs) {
        if (!pair.changes.empty()) {
            json.push_back(
                {{"configuration", store::key_json(report.run.results.entries[pair.now].key)},
                 {"changed_parameters", changes_json(pair.changes)}});
        }
    }
    return json;
}

store::Json keys_json(const std::vector<std::size_t>& indices, const analysis::GateEntries& entries)
{
    store::Json json = store::Json::array();
    for (const std::size_t index : indices) {
        json.push_back(store::key_json(entries.entries[index].key));
    }
    return json;
}

store::Json improvements_json(const GateReport& report)
{
    store::Json json = store::Json::array();
    for (const analysis::GateImprovement& one : report.outcome.improvements) {
        json.push_back(
            {{"configuration", store::key_json(report.run.results.entries[one.entry].key)},
             {"metric", one.metric},
             {"baseline", store::metric_json(one.metric, one.before)},
             {"now", store::metric_json(one.metric, one.now)}});
    }
    return json;
}

} // namespace

std::string gate_json(const GateReport& report)
{
    const analysis::GateOutcome& outcome = report.outcome;
    store::Json findings = store::Json::array();
    for (const analysis::GateFinding& finding : outcome.findings) {
        findings.push_back(finding_json(report, finding));
    }
    store::Json unmatched = store::Json::array();
    for (const std::size_t rule : outcome.unmatched_rules) {
        unmatched.push_back(report.rules[rule].id);
    }
    const store::RunStatus& status = report.run.status;
    const store::Json json{
        {"schema", 1},
        {"result", verdict_name(report.verdict)},
        {"same_environment", outcome.is_same_renderer && !report.run.has_several_environments},
        {"environment",
         {{"baseline", environment_json(report.baseline.environment)},
          {"now", environment_json(report.run.results.environment)}}},
        {"configurations",
         {{"compared", outcome.pairs.size()},
          {"failed", status.failed},
          {"not_computed", status.missing}}},
        {"findings", std::move(findings)},
        {"changed", changed_json(report)},
        {"missing", keys_json(outcome.missing, report.baseline)},
        {"new", keys_json(outcome.added, report.run.results)},
        {"improvements", improvements_json(report)},
        {"unmatched_rules", std::move(unmatched)}};
    return json.dump(2, ' ', false, store::Json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::reports
