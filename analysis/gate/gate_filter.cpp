#include "analysis/gate/gate_filter.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "analysis/results/metric_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace gnomon::analysis {

namespace {

/// Every kind of error that exists. Source: docs/causes.md.
constexpr std::array<KindOfError, 16> possible_kinds{{{false, Cause::bias, Label::overshadow},
                                                      {false, Cause::coverage, Label::overshadow},
                                                      {false, Cause::precision, Label::acne},
                                                      {false, Cause::precision, Label::edge},
                                                      {false, Cause::filter, Label::acne},
                                                      {false, Cause::filter, Label::edge},
                                                      {false, Cause::filter, Label::overshadow},
                                                      {false, Cause::resolution, Label::acne},
                                                      {false, Cause::resolution, Label::edge},
                                                      {true, Cause::bias, Label::peter_panning},
                                                      {true, Cause::precision, Label::leak},
                                                      {true, Cause::coverage, Label::leak},
                                                      {true, Cause::filter, Label::edge},
                                                      {true, Cause::filter, Label::bleed},
                                                      {true, Cause::resolution, Label::edge},
                                                      {true, Cause::resolution, Label::leak}}};

/// The index of the name behind the prefix; 0, "none", if it is not among the names.
template <typename Names>
std::size_t code_in(std::string_view metric, std::string_view prefix, const Names& names)
{
    if (!metric.starts_with(prefix)) {
        return 0;
    }
    const auto found = std::find(names.begin() + 1, names.end(), metric.substr(prefix.size()));
    return found == names.end() ? 0 : static_cast<std::size_t>(found - names.begin());
}

std::size_t cause_code(std::string_view metric)
{
    return std::max(code_in(metric, "causes.", cause_names),
                    code_in(metric, "cause_amounts.", cause_names));
}
std::size_t label_code(std::string_view metric)
{
    return std::max(code_in(metric, "labels.", label_names),
                    code_in(metric, "label_amounts.", label_names));
}

/// Whether the metric is the number or the amount of errors on both sides.
bool is_of_both_sides(std::string_view metric)
{
    return metric == wrong_pixels_metric || metric == error_amount_metric ||
           cause_code(metric) > 0 || label_code(metric) > 0;
}

/// A quantity's name as a metric: those that count right pixels are pixel classes.
std::string metric_name(const SubsetQuantity& quantity)
{
    const bool is_class = quantity.name == "lit" || quantity.name == "blocked";
    return is_class ? fmt::format("pixels.{}", quantity.name) : std::string{quantity.name};
}

/// Sums the cells that the filter takes; empty if it takes none.
std::optional<SubsetCounts> sum_cells(const std::vector<ErrorBucket>& cells,
                                      const PixelFilter& filter)
{
    std::optional<SubsetCounts> sums;
    for (const ErrorBucket& cell : cells) {
        if (!filter.has(cell)) {
            continue;
        }
        SubsetCounts& sum = sums ? *sums : sums.emplace();
        sum.lit += cell.lit;
        sum.blocked += cell.blocked;
        for (const KindOfError& kind : cell.errors) {
            if (filter.has(kind)) {
                (kind.is_false_lit ? sum.false_lit : sum.false_shadow) += kind.pixels;
                (kind.is_false_lit ? sum.light_amount : sum.shadow_amount) += kind.amount;
            }
        }
    }
    return sums;
}

/// The filter narrowed to the cause or label of the metric; empty if they contradict.
std::optional<PixelFilter> narrowed(PixelFilter filter, std::string_view metric)
{
    if (const std::size_t code = cause_code(metric); code > 0) {
        const auto cause = static_cast<Cause>(code);
        if (filter.cause && *filter.cause != cause) {
            return std::nullopt;
        }
        filter.cause = cause;
    }
    if (const std::size_t code = label_code(metric); code > 0) {
        const auto label = static_cast<Label>(code);
        if (filter.label && *filter.label != label) {
            return std::nullopt;
        }
        filter.label = label;
    }
    return filter;
}

} // namespace

bool PixelFilter::has(const ErrorBucket& cell) const
{
    return (!object || *object == cell.object) && (!bands || bands->has(cell.band));
}

bool PixelFilter::has(const KindOfError& kind) const
{
    return (!cause || *cause == kind.cause) && (!label || *label == kind.label);
}

bool is_of_pixels(std::string_view metric)
{
    const auto is_quantity = [&](const SubsetQuantity& one) { return metric_name(one) == metric; };
    const auto is_rate = [&](const SubsetRate& one) { return one.name == metric; };
    return is_of_both_sides(metric) || std::ranges::any_of(subset_quantities(), is_quantity) ||
           std::ranges::any_of(subset_rates(), is_rate);
}

bool counts_side(std::string_view metric, bool is_false_lit)
{
    const bool is_of_lit =
        metric.starts_with("false_shadow") || metric.starts_with("shadow_amount");
    const bool is_of_blocked =
        metric.starts_with("false_lit") || metric.starts_with("light_amount");
    return is_false_lit ? !is_of_lit : !is_of_blocked;
}

std::optional<PixelFilter> counted_pixels(std::string_view metric, const PixelFilter& filter)
{
    return is_of_pixels(metric) && !metric.starts_with("pixels.") ? narrowed(filter, metric)
                                                                  : std::nullopt;
}

bool can_count(std::string_view metric, const PixelFilter& filter)
{
    if (metric.starts_with("pixels.")) {
        return !filter.cause && !filter.label;
    }
    const auto meant = narrowed(filter, metric);
    return meant && std::ranges::any_of(possible_kinds, [&](const KindOfError& kind) {
               return counts_side(metric, kind.is_false_lit) && meant->has(kind);
           });
}

std::optional<double> metric_of_pixels(const std::vector<ErrorBucket>& cells,
                                       std::string_view metric, const PixelFilter& filter)
{
    const auto meant = narrowed(filter, metric);
    const auto found = sum_cells(cells, meant ? *meant : filter);
    if (!found) {
        return std::nullopt;
    }
    if (!meant) {
        return 0.0;
    }
    for (const SubsetRate& rate : subset_rates()) {
        if (rate.name == metric) {
            return rate_of(rate, *found);
        }
    }
    for (const SubsetQuantity& quantity : subset_quantities()) {
        if (metric_name(quantity) == metric) {
            return quantity.number(*found);
        }
    }
    return is_amount(metric) ? found->shadow_amount + found->light_amount
                             : static_cast<double>(found->false_shadow + found->false_lit);
}

} // namespace gnomon::analysis
