#include "analysis/gate/gate_rules.hpp"

#include "analysis/cause.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::analysis {

namespace {

constexpr double changed_job_share = 1e-4;
constexpr double changed_job_gap = 0.05;

bool is_same_value(std::string_view wanted, std::string_view value)
{
    const std::optional<double> wanted_number = number_in(wanted);
    const std::optional<double> number = number_in(value);
    return wanted == value || (wanted_number && number && *wanted_number == *number);
}

GateRule optional_rule(std::string_view metric, JobState job)
{
    GateRule rule;
    rule.id = fmt::format("{}{}", metric, job == JobState::changed ? ", changed job" : "");
    rule.metric = metric;
    rule.job = job;
    rule.is_optional = true;
    return rule;
}

void add_count_rules(std::vector<GateRule>& rules, std::string_view metric)
{
    GateRule unchanged = optional_rule(metric, JobState::unchanged);
    unchanged.allow_pixels = 0;
    rules.push_back(std::move(unchanged));
    GateRule changed = optional_rule(metric, JobState::changed);
    changed.allow_share = changed_job_share;
    rules.push_back(std::move(changed));
}

void add_gap_rules(std::vector<GateRule>& rules, std::string_view metric)
{
    GateRule unchanged = optional_rule(metric, JobState::unchanged);
    unchanged.abs = 0;
    rules.push_back(std::move(unchanged));
    GateRule changed = optional_rule(metric, JobState::changed);
    changed.rel = changed_job_gap;
    rules.push_back(std::move(changed));
}

} // namespace

bool is_meant(const GateRule& rule, const GateEntry& now, bool unchanged)
{
    if (rule.job != JobState::any && (rule.job == JobState::unchanged) != unchanged) {
        return false;
    }
    return std::all_of(rule.where.begin(), rule.where.end(), [&](const auto& wanted) {
        const auto value = now.setting(wanted.first);
        return value && is_same_value(wanted.second, *value);
    });
}

std::vector<GateRule> default_gate_rules()
{
    std::vector<GateRule> rules;
    add_count_rules(rules, "false_shadow");
    add_count_rules(rules, "false_lit");
    for (std::size_t i = 1; i < cause_names.size(); ++i) { // the first is "none"
        add_count_rules(rules, fmt::format("causes.{}", cause_names[i]));
    }
    for (std::size_t i = 1; i < label_names.size(); ++i) {
        add_count_rules(rules, fmt::format("labels.{}", label_names[i]));
    }
    add_gap_rules(rules, "peter_panning_gap_m.p95");
    add_gap_rules(rules, "peter_panning_gap_m.max");
    GateRule mismatch = optional_rule("unmatched_kinds.mismatch", JobState::any);
    mismatch.max = 0;
    rules.push_back(std::move(mismatch));
    return rules;
}

} // namespace gnomon::analysis
