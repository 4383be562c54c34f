#include "reports/text/remedy_text.hpp"

#include "analysis/pixels/statistics.hpp"
#include "reports/text/description.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string_view>

namespace gnomon::reports {

namespace {

constexpr double finer_step = 2; // mention a step at most half as long

/// A share of the scored pixels.
std::string of_surface(const analysis::Comparison& comparison, double amount)
{
    return percent(analysis::ratio(amount, comparison.metrics.pixels.scored()));
}

/// "; but it shadows 60 % of the lit surface": a remedy's side effect, if it affects most of the
/// lit surface. `ranked_remedies` excludes those that light most of the shadows.
std::string price_text(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    constexpr double most = 0.5;
    const analysis::Metrics& now = comparison.metrics;
    const auto shadowed =
        analysis::ratio(remedy.outcome.amounts.shadow, now.pixels.of(scene::PixelClass::lit));
    if (shadowed > most && shadowed > now.shadow_amount_rate) {
        return fmt::format("; but it shadows {} of the lit surface", percent(shadowed));
    }
    return "";
}

/// How a remedy changes the wrong pixels, and the amount with softened borders if it is not
/// reduced. Empty if all measures agree.
std::string changes_text(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    using analysis::Change;
    if (is_counted(comparison, remedy)) {
        return "";
    }
    const auto [wrong, amount] = analysis::changes_of(comparison, remedy);
    const analysis::Metrics& now = comparison.metrics;
    const std::string counts =
        fmt::format("{} in place of {}", counted(remedy.outcome.errors.total(), "wrong pixel"),
                    grouped(now.false_shadow + now.false_lit));
    const std::string amounts = fmt::format("an amount of {} with softened borders in place of {}",
                                            of_surface(comparison, remedy.outcome.amounts.total()),
                                            percent(now.mean_abs_error));
    if (wrong == Change::less) {
        return amount == Change::less ? fmt::format(", and {}", counts)
                                      : fmt::format(", and {}; but {}", counts, amounts);
    }
    return amount == Change::less ? fmt::format("; but {}", counts)
                                  : fmt::format("; but {}, and {}", counts, amounts);
}

/// "; a step of d16 is then 0.0012 m in place of 0.34 m"
std::string step_text(const analysis::Remedy& remedy, std::string_view unit)
{
    const auto& [before_m, after_m] = remedy.step;
    if (!(after_m > 0) || before_m < finer_step * after_m) {
        return "";
    }
    return fmt::format("; a step of the stored depth is then {:.2g} {} at the median receiver, in "
                       "place of {:.2g} {}",
                       after_m, unit, before_m, unit);
}

/// " In the worst of 9 views it leaves 0.41 % (camera 3)."
std::string views_text(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    if (remedy.views.size() < 2) {
        return "";
    }
    const std::size_t worst = analysis::worst_view(remedy.views);
    const bool is_amount = has_fractions(comparison.metrics);
    return fmt::format(" Over {} views it leaves {}at most {} ({}).", remedy.views.size(),
                       is_amount ? "an amount without softened borders of " : "",
                       percent(remedy.views[worst].error_rate()),
                       comparison.advice_views.views.at(worst).name);
}

/// ", with a map of 4 MiB"; empty if the map's memory stays.
std::string memory_text(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    return remedy.cost.map_bytes == analysis::lookup_cost(comparison.job).map_bytes
               ? std::string{}
               : fmt::format(", with a map of {}", mebibytes(remedy.cost.map_bytes));
}

/// "; 1,035 pixels wrong, from 6,737": what amounts alone do not say.
std::string counts_in_brief(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    using analysis::Change;
    const auto [wrong, amount] = analysis::changes_of(comparison, remedy);
    const analysis::Metrics& now = comparison.metrics;
    std::string text = fmt::format("; {}{} wrong, from {}", wrong == Change::more ? "but " : "",
                                   counted(remedy.outcome.errors.total(), "pixel"),
                                   grouped(now.false_shadow + now.false_lit));
    if (amount == Change::more) {
        text += fmt::format("; but with softened borders {} by amount, from {}",
                            of_surface(comparison, remedy.outcome.amounts.total()),
                            percent(now.mean_abs_error));
    }
    return text;
}

} // namespace

bool is_counted(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    const analysis::Outcome& left = remedy.outcome;
    return !has_fractions(comparison.metrics) && left.softening == 0 &&
           left.amounts.total() == static_cast<double>(left.errors.total());
}

std::string remedy_keys(const analysis::Remedy& remedy, std::string_view unit)
{
    constexpr std::string_view comment = analysis::origin_comment; // marks a change that is no key
    std::string text = fmt::format("{}", fmt::join(remedy.keys, ", "));
    if (text.starts_with(comment)) {
        return fmt::format("Moving {}", text.substr(comment.size()));
    }
    if (remedy.bias && remedy.bias->depth > 0 && std::isfinite(remedy.bias->metres)) {
        text += fmt::format(" ({:.3g} {}, {:.3g} {})", remedy.bias->metres, unit,
                            remedy.bias->texels, remedy.bias->texels == 1 ? "texel" : "texels");
    }
    return text;
}

std::string remedy_toml(const analysis::Remedy& remedy)
{
    return fmt::format("{}\n", fmt::join(remedy.keys, "\n"));
}

std::string remedy_sentence(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    const std::string left = of_surface(comparison, remedy.outcome.error_amount());
    std::string text =
        fmt::format("{} leaves {}, in place of {}", remedy_keys(remedy, length_unit(comparison)),
                    is_counted(comparison, remedy)
                        ? fmt::format("{} of the surface wrong", left)
                        : fmt::format("an amount of error of {} without softened borders", left),
                    of_surface(comparison, analysis::error_amount(comparison)));
    text += changes_text(comparison, remedy) + memory_text(comparison, remedy);
    return text + price_text(comparison, remedy) + step_text(remedy, length_unit(comparison)) +
           "." + views_text(comparison, remedy);
}

std::string remedy_effect(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    const bool is_count = is_counted(comparison, remedy);
    return fmt::format(
        "{} wrong{}, from {}{}{}{}{}.{}", of_surface(comparison, remedy.outcome.error_amount()),
        is_count ? "" : " by amount", of_surface(comparison, analysis::error_amount(comparison)),
        is_count ? "" : counts_in_brief(comparison, remedy), memory_text(comparison, remedy),
        price_text(comparison, remedy), step_text(remedy, length_unit(comparison)),
        views_text(comparison, remedy));
}

std::string remedy_in_brief(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    std::string text = fmt::format(
        "{}: leaves {}{}, {}", remedy_keys(remedy, length_unit(comparison)),
        of_surface(comparison, remedy.outcome.error_amount()),
        is_counted(comparison, remedy) ? "" : " by amount", mebibytes(remedy.cost.map_bytes));
    if (remedy.cost.taps != analysis::lookup_cost(comparison.job).taps) {
        text += fmt::format(", {}", counted(static_cast<std::uint64_t>(remedy.cost.taps), "tap"));
    }
    return text + worsening_text(comparison, remedy);
}

std::string worsening_text(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    using analysis::Change;
    const analysis::ErrorChanges changes = analysis::changes_of(comparison, remedy);
    return fmt::format(
        "{}{}", changes.wrong_pixels == Change::more ? "; more pixels are wrong" : "",
        changes.amount == Change::more ? "; the amount with softened borders is larger" : "");
}

std::string mebibytes(std::uint64_t bytes)
{
    return fmt::format("{:.3g} MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
}

} // namespace gnomon::reports
