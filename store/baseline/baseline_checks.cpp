#include "store/baseline/baseline.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "analysis/results/metric_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::store {

namespace {

using analysis::GateEntry;
using Names = std::vector<std::string>;

/// The sum of metrics; empty if one is missing.
std::optional<double> sum_of(const GateEntry& entry, const Names& names)
{
    double sum = 0;
    for (const std::string& name : names) {
        const auto value = entry.metric(name);
        if (!value) {
            return std::nullopt;
        }
        sum += *value;
    }
    return sum;
}

template <typename List>
Names names_of(std::string_view prefix, const List& list)
{
    Names names;
    for (std::size_t i = 1; i < list.size(); ++i) { // the first is "none"
        names.push_back(fmt::format("{}{}", prefix, list[i]));
    }
    return names;
}

std::string difference(std::string_view what, const std::optional<double>& a,
                       std::string_view other, const std::optional<double>& b)
{
    return a && b && *a != *b ? fmt::format("{} is {}, but {} {}", what, *a, other, *b)
                              : std::string{};
}

std::string total_contradiction(const GateEntry& entry)
{
    const auto total = entry.metric("pixels.total");
    for (const auto& [name, value] : entry.metrics) {
        const analysis::GateMetric* const metric = analysis::find_gate_metric(name);
        if (total && metric != nullptr && metric->is_pixel_count && value > *total) {
            return fmt::format("{} is {}, but pixels.total {}", name, value, *total);
        }
    }
    const auto side = [&](const char* key) {
        const auto text = entry.setting(key);
        return text ? analysis::number_in(*text) : std::nullopt;
    };
    const auto width = side("image.width");
    const auto height = side("image.height");
    if (!width || !height) {
        return {};
    }
    return difference("pixels.total", total, "the image has", *width * *height);
}

std::string sum_contradiction(const GateEntry& entry)
{
    const auto wrong = sum_of(entry, {"false_shadow", "false_lit"});
    std::string sums =
        difference("pixels.total", entry.metric("pixels.total"), "its classes sum to",
                   sum_of(entry, {"pixels.background", "pixels.unmatched", "pixels.attached",
                                  "pixels.out_of_light", "pixels.indeterminate", "pixels.lit",
                                  "pixels.blocked"}));
    if (!sums.empty()) {
        return sums;
    }
    std::string causes = difference("false_shadow + false_lit", wrong, "all causes sum to",
                                    sum_of(entry, names_of("causes.", analysis::cause_names)));
    if (!causes.empty()) {
        return causes;
    }
    return difference("false_shadow + false_lit", wrong, "all labels sum to",
                      sum_of(entry, names_of("labels.", analysis::label_names)));
}

/// The rounding error allowed in an amount, which is a sum of fractions: 10^-9 of the pixels.
double allowed_amount(const GateEntry& entry)
{
    return 1e-9 * std::max(1.0, entry.metric("pixels.total").value_or(0));
}

std::string amount_contradiction(const GateEntry& entry)
{
    const auto all = sum_of(entry, {"shadow_amount", "light_amount"});
    const auto unassigned = entry.metric("unassigned");
    const double allowed = allowed_amount(entry);
    const auto differs = [&](std::string_view what, const std::optional<double>& a,
                             std::string_view other, const std::optional<double>& b) {
        return a && b && std::abs(*a - *b) > allowed ? difference(what, a, other, b)
                                                     : std::string{};
    };
    const auto with_unassigned = [&](std::string_view prefix, const auto& names) {
        const auto sum = sum_of(entry, names_of(prefix, names));
        return sum && unassigned ? std::optional{*sum + *unassigned} : std::nullopt;
    };
    constexpr std::string_view amounts = "shadow_amount + light_amount";
    std::string causes = differs(amounts, all, "all cause_amounts and unassigned sum to",
                                 with_unassigned("cause_amounts.", analysis::cause_names));
    if (!causes.empty()) {
        return causes;
    }
    std::string labels = differs(amounts, all, "all label_amounts and unassigned sum to",
                                 with_unassigned("label_amounts.", analysis::label_names));
    if (!labels.empty()) {
        return labels;
    }
    return differs("softening", entry.metric("softening"), "its two sides sum to",
                   sum_of(entry, {"shadow_softening", "light_softening"}));
}

/// Rates are quotients of sums, and are written so that they read back exactly.
std::string rate_contradiction(const GateEntry& entry)
{
    for (const analysis::SubsetRate& rate : analysis::subset_rates()) {
        const auto wrong = sum_of(entry, {rate.errors.begin(), rate.errors.end()});
        Names pixels;
        for (const std::string_view kind : rate.pixels) {
            pixels.push_back(fmt::format("pixels.{}", kind));
        }
        const auto whole = sum_of(entry, pixels);
        if (!wrong || !whole) {
            continue;
        }
        if (*wrong > *whole) {
            return fmt::format("{} are wrong of {}", *wrong, *whole);
        }
        std::string differs =
            difference(rate.name, entry.metric(std::string{rate.name}), "its counts give",
                       *whole > 0 ? std::optional{*wrong / *whole} : std::nullopt);
        if (!differs.empty()) {
            return differs;
        }
    }
    return {};
}

/// The parts hold all scored pixels. If causes are known, they also hold all errors.
std::string parts_contradiction(const GateEntry& entry)
{
    if (entry.cells.empty()) {
        return {};
    }
    double lit = 0;
    double blocked = 0;
    double false_shadow = 0;
    double false_lit = 0;
    double amount = 0;
    for (const analysis::ErrorBucket& cell : entry.cells) {
        lit += static_cast<double>(cell.lit);
        blocked += static_cast<double>(cell.blocked);
        for (const analysis::KindOfError& kind : cell.errors) {
            (kind.is_false_lit ? false_lit : false_shadow) += static_cast<double>(kind.pixels);
            amount += kind.amount;
        }
    }
    std::map<std::string, double> sums{{"pixels.lit", lit}, {"pixels.blocked", blocked}};
    if (sum_of(entry, names_of("causes.", analysis::cause_names))) {
        sums.insert({{"false_shadow", false_shadow}, {"false_lit", false_lit}});
    }
    for (const auto& [name, sum] : sums) {
        std::string differs = difference(name, entry.metric(name), "its parts sum to", sum);
        if (!differs.empty()) {
            return differs;
        }
    }
    const auto assigned = sum_of(entry, names_of("cause_amounts.", analysis::cause_names));
    return assigned && std::abs(*assigned - amount) > allowed_amount(entry)
               ? difference("all cause_amounts", assigned, "its parts sum to", amount)
               : std::string{};
}

} // namespace

std::string find_contradiction(const GateEntry& entry)
{
    for (const auto check : {total_contradiction, sum_contradiction, amount_contradiction,
                             rate_contradiction, parts_contradiction}) {
        std::string found = check(entry);
        if (!found.empty()) {
            return found;
        }
    }
    return {};
}

} // namespace gnomon::store
