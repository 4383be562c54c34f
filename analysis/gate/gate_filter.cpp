#include "analysis/gate/gate_filter.hpp"

#include "analysis/ratio.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon::analysis {

namespace {

constexpr std::array<std::string_view, 8> pixel_metrics{
    "false_shadow",   "false_lit",  "wrong_pixels", "false_shadow_rate",
    "false_lit_rate", "error_rate", "pixels.lit",   "pixels.blocked"};

/// Every kind of wrong pixel that exists. Source: docs/causes.md.
constexpr std::array<WrongCount, 11> possible_kinds{{{false, Cause::bias, Label::overshadow},
                                                     {false, Cause::coverage, Label::overshadow},
                                                     {false, Cause::precision, Label::acne},
                                                     {false, Cause::precision, Label::edge},
                                                     {false, Cause::resolution, Label::acne},
                                                     {false, Cause::resolution, Label::edge},
                                                     {true, Cause::bias, Label::peter_panning},
                                                     {true, Cause::precision, Label::leak},
                                                     {true, Cause::coverage, Label::leak},
                                                     {true, Cause::resolution, Label::edge},
                                                     {true, Cause::resolution, Label::leak}}};

/// Where the name stands among the others behind the prefix; 0, "none", if it does not.
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
    return code_in(metric, "causes.", cause_names);
}
std::size_t label_code(std::string_view metric)
{
    return code_in(metric, "labels.", label_names);
}

struct PixelSums {
    std::uint64_t lit = 0;
    std::uint64_t blocked = 0;
    std::uint64_t false_shadow = 0;
    std::uint64_t false_lit = 0;
};

/// The pixels of the parts that the filter takes; empty if there is no such part.
std::optional<PixelSums> sum_parts(const std::vector<ErrorPart>& parts, const PixelFilter& filter)
{
    std::optional<PixelSums> sums;
    for (const ErrorPart& part : parts) {
        if (!filter.has(part)) {
            continue;
        }
        PixelSums& sum = sums ? *sums : sums.emplace();
        sum.lit += part.lit;
        sum.blocked += part.blocked;
        for (const WrongCount& wrong : part.wrong) {
            if (filter.has(wrong)) {
                (wrong.is_false_lit ? sum.false_lit : sum.false_shadow) += wrong.pixels;
            }
        }
    }
    return sums;
}

/// The filter narrowed to what a metric of one cause or label counts; empty if that is nothing.
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

bool PixelFilter::has(const ErrorPart& part) const
{
    return (!object || *object == part.object) && (!bands || bands->has(part.band));
}

bool PixelFilter::has(const WrongCount& wrong) const
{
    return (!cause || *cause == wrong.cause) && (!label || *label == wrong.label);
}

bool is_of_pixels(std::string_view metric)
{
    return std::find(pixel_metrics.begin(), pixel_metrics.end(), metric) != pixel_metrics.end() ||
           cause_code(metric) > 0 || label_code(metric) > 0;
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
    return meant &&
           std::any_of(possible_kinds.begin(), possible_kinds.end(), [&](const WrongCount& kind) {
               const bool is_meant =
                   metric.starts_with("false_lit")
                       ? kind.is_false_lit
                       : !metric.starts_with("false_shadow") || !kind.is_false_lit;
               return is_meant && meant->has(kind);
           });
}

std::optional<double> metric_of_pixels(const std::vector<ErrorPart>& parts, std::string_view metric,
                                       const PixelFilter& filter)
{
    const auto meant = narrowed(filter, metric);
    const auto found = sum_parts(parts, meant ? *meant : filter);
    if (!found) {
        return std::nullopt;
    }
    if (!meant) {
        return 0.0;
    }
    const PixelSums& sum = *found;
    const std::uint64_t wrong = sum.false_shadow + sum.false_lit;
    if (metric == "false_shadow_rate") {
        return ratio(sum.false_shadow, sum.lit);
    }
    if (metric == "false_lit_rate") {
        return ratio(sum.false_lit, sum.blocked);
    }
    if (metric == "error_rate") {
        return ratio(wrong, sum.lit + sum.blocked);
    }
    const std::uint64_t count = metric == "false_shadow"     ? sum.false_shadow
                                : metric == "false_lit"      ? sum.false_lit
                                : metric == "pixels.lit"     ? sum.lit
                                : metric == "pixels.blocked" ? sum.blocked
                                                             : wrong;
    return static_cast<double>(count);
}

} // namespace gnomon::analysis
