#include "analysis/gate/gate_judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

namespace gnomon::analysis {

namespace {

/// Fills `pairs`, `missing` and `added` from the two sorted lists.
void match_entries(GateOutcome& outcome, const GateEntries& baseline, const GateEntries& run)
{
    std::size_t before = 0;
    std::size_t now = 0;
    while (before < baseline.entries.size() || now < run.entries.size()) {
        const GateEntry* const old =
            before < baseline.entries.size() ? &baseline.entries[before] : nullptr;
        const GateEntry* const fresh = now < run.entries.size() ? &run.entries[now] : nullptr;
        if (fresh == nullptr || (old != nullptr && old->key < fresh->key)) {
            outcome.missing.push_back(before++);
        } else if (old == nullptr || fresh->key < old->key) {
            outcome.added.push_back(now++);
        } else {
            outcome.pairs.push_back(
                {before++, now++, changed_parameters(*old, *fresh), dominant_cause(*old, *fresh)});
        }
    }
}

/// How much worse the metric became; negative if it became better.
double worsening(Worse worse, double before, double now)
{
    const double change = now - before;
    if (worse == Worse::both) {
        return std::abs(change);
    }
    return worse == Worse::up ? change : -change;
}

double allowed_change(const GateRule& rule, double before, const GateEntry& now)
{
    double allowed = std::max(rule.abs.value_or(0), rule.allow_pixels.value_or(0));
    allowed = std::max(allowed, rule.rel.value_or(0) * std::abs(before));
    const double image_pixels = now.metric("pixels.total").value_or(0);
    return std::max(allowed, rule.allow_share.value_or(0) * image_pixels);
}

/// How much worse a metric may become in exchange for other pixels that became right.
double traded_change(const GateRule& rule, const GateEntry& before, const GateEntry& now)
{
    const std::string name{is_amount(rule.metric) ? error_amount_metric : wrong_pixels_metric};
    const auto was = before.metric(name);
    const auto is = now.metric(name);
    if (!rule.trade_off || !was || !is) {
        return 0;
    }
    const double fall = *was - *is;
    // Causes and labels divide the errors: if these did not grow, one took over from another.
    const bool shares_out = rule.metric.starts_with("cause") || rule.metric.starts_with("label");
    const bool is_enough = fall > 0 || (fall == 0 && shares_out);
    return is_enough ? *rule.trade_off * std::max(fall, 1.0) : 0;
}

/// Judges configurations by one rule.
class Judge {
public:
    Judge(GateOutcome& outcome, const GateRule& rule, std::size_t rule_index,
          const AskNewPixels& ask_new_pixels)
        : outcome_{&outcome},
          rule_{&rule},
          rule_index_{rule_index},
          ask_new_pixels_{&ask_new_pixels}
    {
    }

    [[nodiscard]] std::size_t rule_index() const { return rule_index_; }

    /// @param before  nullptr if the baseline lacks it.
    /// @return  Whether there was a value to judge.
    bool judge(const GateEntry* before, const GateEntry& now, std::size_t entry)
    {
        if (rule_->metric == new_pixels_metric) {
            return before != nullptr && judge_new_pixels(*before, now, entry);
        }
        bool is_judged = false;
        for (const PixelFilter& filter : filters_of(*rule_, before, now)) {
            is_judged = judge_values(before, now, {rule_index_, entry, {}, {}, {}, {}, filter}) ||
                        is_judged;
        }
        return is_judged;
    }

private:
    bool judge_new_pixels(const GateEntry& before, const GateEntry& now, std::size_t entry)
    {
        if (rule_->is_optional && before.pixels.empty()) {
            return false;
        }
        GateFinding finding{rule_index_, entry, {}, {}, {}, {}, rule_->pixels};
        NewPixelAnswer answer;
        if (before.pixels.empty()) {
            answer.obstacle = "the baseline does not have its pixels";
        } else if (now.pixels.empty()) {
            answer.obstacle = "the run did not keep its pixels";
        } else {
            answer = (*ask_new_pixels_)(before, now, rule_->pixels);
        }
        if (!answer.found) {
            finding.obstacle = answer.obstacle;
            add(std::move(finding), GateReason::not_available, std::nullopt);
            return true;
        }
        finding.before = 0;
        finding.now = static_cast<double>(answer.found->count);
        finding.cause = answer.found->cause;
        finding.new_pixels = std::move(answer.found);
        judge_limits(finding, *finding.now);
        judge_change(finding, *finding.now, before, now);
        return true;
    }

    bool judge_values(const GateEntry* before, const GateEntry& now, GateFinding finding)
    {
        finding.before =
            before == nullptr ? std::nullopt : before->metric(rule_->metric, finding.filter);
        finding.now = now.metric(rule_->metric, finding.filter);
        if (!finding.before && !finding.now) {
            return false;
        }
        if (before != nullptr) {
            const auto counted = counted_pixels(rule_->metric, finding.filter);
            finding.cause = dominant_cause(*before, now, counted.value_or(finding.filter));
        }
        if (!finding.now) {
            finding.obstacle = "the metric has no value in the run";
            add(std::move(finding), GateReason::not_available, std::nullopt);
            return true;
        }
        judge_limits(finding, *finding.now);
        if (before != nullptr && rule_->judges_change()) {
            judge_change(finding, *finding.now, *before, now);
        }
        return true;
    }

    void judge_limits(const GateFinding& finding, double value)
    {
        if (rule_->max && value > *rule_->max) {
            add(finding, GateReason::above_max, rule_->max);
        } else if (rule_->min && value < *rule_->min) {
            add(finding, GateReason::below_min, rule_->min);
        }
    }

    void judge_change(GateFinding finding, double value, const GateEntry& before,
                      const GateEntry& now)
    {
        if (!finding.before) {
            finding.obstacle = "the metric has no value in the baseline";
            add(std::move(finding), GateReason::not_available, std::nullopt);
            return;
        }
        if (!rule_->judges_change()) {
            return;
        }
        const double worse = worsening(rule_->worse, *finding.before, value);
        const double allowed = allowed_change(*rule_, *finding.before, now);
        if (worse > allowed) {
            const bool is_traded = worse <= traded_change(*rule_, before, now);
            add(std::move(finding),
                is_traded ? GateReason::traded_off : GateReason::worse_than_baseline, allowed);
        } else if (worse < 0 && finding.filter.takes_all() &&
                   rule_->metric != scored_pixels_metric) {
            outcome_->improvements.push_back(
                {finding.entry, rule_->metric, *finding.before, value});
        }
    }

    void add(GateFinding finding, GateReason reason, const std::optional<double>& limit)
    {
        const bool is_fewer =
            reason == GateReason::below_min ||
            (reason == GateReason::worse_than_baseline && finding.now < finding.before);
        finding.reason =
            rule_->metric == scored_pixels_metric && is_fewer ? GateReason::nothing_tested : reason;
        finding.limit = limit;
        outcome_->findings.push_back(std::move(finding));
    }

    GateOutcome* outcome_;
    const GateRule* rule_;
    std::size_t rule_index_;
    const AskNewPixels* ask_new_pixels_;
};

void apply_rule(GateOutcome& outcome, const GateEntries& baseline, const GateEntries& run,
                const GateRule& rule, Judge judge)
{
    bool is_matched = false;
    for (const GatePair& pair : outcome.pairs) {
        const GateEntry& now = run.entries[pair.now];
        if (is_meant(rule, now, outcome.is_same_renderer && pair.changes.empty())) {
            is_matched = judge.judge(&baseline.entries[pair.before], now, pair.now) || is_matched;
        }
    }
    for (const std::size_t entry : outcome.added) {
        if (is_meant(rule, run.entries[entry], false)) {
            is_matched = judge.judge(nullptr, run.entries[entry], entry) || is_matched;
        }
    }
    if (!is_matched && !rule.is_optional) {
        outcome.unmatched_rules.push_back(judge.rule_index());
    }
}

/// A key that sorts worse findings first.
std::tuple<bool, bool, bool, double> finding_rank(const GateFinding& finding,
                                                  std::span<const GateRule> rules)
{
    const GateRule& rule = rules[finding.rule];
    const GateMetric* const metric = find_gate_metric(rule.metric);
    const bool is_count = metric != nullptr && metric->is_pixel_count;
    const double now = finding.now.value_or(0);
    const double reference =
        finding.before.value_or(finding.reason == GateReason::worse_than_baseline ||
                                        finding.reason == GateReason::traded_off
                                    ? 0
                                    : finding.limit.value_or(0));
    const double size = std::abs(now - reference);
    const double scale = std::max(std::abs(reference), std::numeric_limits<double>::min());
    return {severity_of(finding, rules) == Severity::warn,
            finding.reason == GateReason::not_available, !is_count,
            is_count ? -size : -size / scale};
}

/// Keeps each improvement once: several rules may judge one metric.
void tidy_improvements(GateOutcome& outcome)
{
    std::vector<GateImprovement>& all = outcome.improvements;
    const auto place = [](const GateImprovement& one) { return std::tie(one.entry, one.metric); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const auto& a, const auto& b) { return place(a) < place(b); });
    all.erase(std::unique(all.begin(), all.end(),
                          [&](const auto& a, const auto& b) { return place(a) == place(b); }),
              all.end());
}

/// Drops consequences of other findings. If a rule fails because nothing is tested, nothing became
/// better; if no pixel is scored, rates have no value.
void drop_what_follows(GateOutcome& outcome, std::span<const GateRule> rules)
{
    std::set<std::size_t> untested;
    std::set<std::size_t> unscored;
    for (const GateFinding& finding : outcome.findings) {
        if (finding.reason == GateReason::nothing_tested &&
            severity_of(finding, rules) == Severity::fail) {
            untested.insert(finding.entry);
            if (finding.now == 0.0) {
                unscored.insert(finding.entry);
            }
        }
    }
    std::erase_if(outcome.findings, [&](const GateFinding& finding) {
        return finding.reason == GateReason::not_available &&
               rules[finding.rule].metric != new_pixels_metric && unscored.contains(finding.entry);
    });
    std::erase_if(outcome.improvements, [&](const GateImprovement& improvement) {
        return untested.contains(improvement.entry);
    });
}

} // namespace

Severity severity_of(const GateFinding& finding, std::span<const GateRule> rules)
{
    return finding.reason == GateReason::traded_off ? Severity::warn : rules[finding.rule].severity;
}

std::size_t GateOutcome::broken(std::span<const GateRule> rules, Severity severity) const
{
    return static_cast<std::size_t>(
        std::count_if(findings.begin(), findings.end(), [&](const GateFinding& finding) {
            return finding.reason != GateReason::not_available &&
                   severity_of(finding, rules) == severity;
        }));
}

bool GateOutcome::is_incomplete(std::span<const GateRule> rules) const
{
    return !missing.empty() ||
           std::any_of(findings.begin(), findings.end(), [&](const GateFinding& finding) {
               return finding.reason == GateReason::not_available &&
                      severity_of(finding, rules) == Severity::fail;
           });
}

const GatePair* GateOutcome::pair_of(std::size_t entry) const
{
    const auto found = std::lower_bound(
        pairs.begin(), pairs.end(), entry,
        [](const GatePair& pair, std::size_t wanted) { return pair.now < wanted; });
    return found == pairs.end() || found->now != entry ? nullptr : &*found;
}

GateOutcome judge_run(const GateEntries& baseline, const GateEntries& run,
                      std::span<const GateRule> rules, const AskNewPixels& ask_new_pixels)
{
    GateOutcome outcome;
    outcome.is_same_renderer = is_same_renderer(baseline.environment, run.environment);
    match_entries(outcome, baseline, run);
    for (std::size_t i = 0; i < rules.size(); ++i) {
        apply_rule(outcome, baseline, run, rules[i], {outcome, rules[i], i, ask_new_pixels});
    }
    drop_what_follows(outcome, rules);
    std::stable_sort(outcome.findings.begin(), outcome.findings.end(),
                     [&](const GateFinding& a, const GateFinding& b) {
                         return finding_rank(a, rules) < finding_rank(b, rules);
                     });
    tidy_improvements(outcome);
    return outcome;
}

GateVerdict gate_verdict(const GateOutcome& outcome, std::span<const GateRule> rules,
                         bool is_complete)
{
    if (!is_complete || outcome.is_incomplete(rules)) {
        return GateVerdict::incomplete;
    }
    return outcome.broken(rules, Severity::fail) > 0 ? GateVerdict::regression : GateVerdict::pass;
}

} // namespace gnomon::analysis
