#include "analysis/gate/gate_rules.hpp"

#include "analysis/causes/cause.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

namespace {

constexpr double changed_job_share = 1e-5;
constexpr double changed_job_gap = 0.05;
constexpr double changed_job_trade_off = 0.1;
constexpr double changed_job_mean = 1e-4;
constexpr double changed_job_scored = 0.1;
/// A shadow that comes back has a filter's soft border, which adds to both amounts.
constexpr double changed_job_amount_trade_off = 0.5;
constexpr double any_trade_off = std::numeric_limits<double>::infinity();

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

void add_count_rules(std::vector<GateRule>& rules, std::string_view metric, double trade_off)
{
    GateRule unchanged = optional_rule(metric, JobState::unchanged);
    unchanged.allow_pixels = 0;
    rules.push_back(std::move(unchanged));
    GateRule changed = optional_rule(metric, JobState::changed);
    changed.allow_share = changed_job_share;
    changed.trade_off = trade_off;
    rules.push_back(std::move(changed));
}

/// Limits each object and each band, whatever the others do.
void add_cell_rules(std::vector<GateRule>& rules)
{
    struct CellRule {
        std::string_view metric;
        double trade_off;
    };
    for (const auto& [metric, trade_off] :
         {CellRule{wrong_pixels_metric, changed_job_trade_off},
          CellRule{error_amount_metric, changed_job_amount_trade_off}}) {
        for (const bool each_object : {true, false}) {
            for (const JobState job : {JobState::unchanged, JobState::changed}) {
                GateRule rule = optional_rule(metric, job);
                rule.id = fmt::format("{} of each {}", rule.metric,
                                      each_object ? "object" : "band of light distance");
                rule.each_object = each_object;
                rule.each_band = !each_object;
                if (job == JobState::unchanged) {
                    rule.allow_pixels = 0;
                } else {
                    rule.id += ", changed job";
                    rule.allow_share = changed_job_share;
                    rule.trade_off = trade_off;
                }
                rules.push_back(std::move(rule));
            }
        }
    }
}

void add_new_pixel_rules(std::vector<GateRule>& rules)
{
    GateRule unchanged = optional_rule(new_pixels_metric, JobState::unchanged);
    unchanged.allow_pixels = 0;
    rules.push_back(std::move(unchanged));
    GateRule changed = optional_rule(new_pixels_metric, JobState::changed);
    changed.allow_share = changed_job_share;
    changed.severity = Severity::warn;
    rules.push_back(std::move(changed));
}

void add_gap_rules(std::vector<GateRule>& rules, std::string_view metric)
{
    GateRule unchanged = optional_rule(metric, JobState::unchanged);
    unchanged.abs = 0;
    rules.push_back(std::move(unchanged));
    GateRule changed = optional_rule(metric, JobState::changed);
    changed.rel = changed_job_gap;
    changed.trade_off = any_trade_off; // of fewer pixels, the longest gaps may be those that stay
    rules.push_back(std::move(changed));
}

/// The mean falls if one amount falls by more than the other grows.
void add_mean_rules(std::vector<GateRule>& rules)
{
    GateRule unchanged = optional_rule("mean_abs_error", JobState::unchanged);
    unchanged.abs = 0;
    rules.push_back(std::move(unchanged));
    GateRule changed = optional_rule("mean_abs_error", JobState::changed);
    changed.abs = changed_job_mean;
    rules.push_back(std::move(changed));
}

/// An unchanged job has an unchanged truth.
void add_class_rules(std::vector<GateRule>& rules)
{
    for (const std::string_view name : scene::pixel_class_names) {
        GateRule rule = optional_rule(fmt::format("pixels.{}", name), JobState::unchanged);
        rule.allow_pixels = 0;
        rule.worse = Worse::both;
        rules.push_back(std::move(rule));
    }
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

std::vector<PixelFilter> filters_of(const GateRule& rule, const GateEntry* before,
                                    const GateEntry& now)
{
    if (!rule.each_object && !rule.each_band) {
        return {rule.pixels};
    }
    std::vector<PixelFilter> filters;
    if (before == nullptr) {
        return filters;
    }
    for (const ErrorBucket& cell : now.cells) {
        PixelFilter filter = rule.pixels;
        if (rule.each_object) {
            filter.object = cell.object;
        }
        if (rule.each_band) {
            filter.bands = LightDistanceBands{cell.band, cell.band};
        }
        const bool is_known =
            std::any_of(before->cells.begin(), before->cells.end(),
                        [&](const ErrorBucket& known) { return filter.has(known); });
        if (is_known && std::find(filters.begin(), filters.end(), filter) == filters.end()) {
            filters.push_back(filter);
        }
    }
    return filters;
}

std::vector<GateRule> default_gate_rules()
{
    std::vector<GateRule> rules;
    add_count_rules(rules, "false_shadow", changed_job_trade_off);
    add_count_rules(rules, "false_lit", changed_job_trade_off);
    add_count_rules(rules, "shadow_amount", changed_job_amount_trade_off);
    add_count_rules(rules, "light_amount", changed_job_amount_trade_off);
    add_mean_rules(rules);
    add_class_rules(rules);
    for (std::size_t i = 1; i < cause_names.size(); ++i) { // the first is "none"
        add_count_rules(rules, fmt::format("causes.{}", cause_names[i]), any_trade_off);
    }
    for (std::size_t i = 1; i < label_names.size(); ++i) {
        add_count_rules(rules, fmt::format("labels.{}", label_names[i]), any_trade_off);
    }
    add_cell_rules(rules);
    add_new_pixel_rules(rules);
    add_gap_rules(rules, "peter_panning_gap_m.p95");
    add_gap_rules(rules, "peter_panning_gap_m.max");
    GateRule mismatch = optional_rule("unmatched_kinds.mismatch", JobState::any);
    mismatch.max = 0;
    rules.push_back(std::move(mismatch));
    std::ranges::move(tested_rules(), std::back_inserter(rules));
    return rules;
}

std::vector<GateRule> tested_rules()
{
    GateRule some = optional_rule(scored_pixels_metric, JobState::changed);
    some.id = "some scored_pixels, changed job";
    some.worse = Worse::down;
    some.min = 1;
    GateRule most = optional_rule(scored_pixels_metric, JobState::changed);
    most.worse = Worse::down;
    most.rel = changed_job_scored;
    return {std::move(some), std::move(most)};
}

} // namespace gnomon::analysis
