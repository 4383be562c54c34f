#include "reports/tables/comparison_parts.hpp"

#include "analysis/advice/remedies.hpp"
#include "analysis/pixels/statistics.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/text/description.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon::reports {

namespace {

/// The heading after the columns: the errors' measure and denominator.
/// @param is_count  Whether no verdict is a fraction.
std::string_view error_heading(bool is_count)
{
    return is_count ? "wrong, of scored" : "amount without softened borders, of scored";
}

/// The errors in each view, for the job and for its first remedy.
std::string views(const analysis::Comparison& comparison, const analysis::Remedy& remedy)
{
    const auto& views = comparison.advice_views.views;
    std::string passed_over;
    if (comparison.advice_views.passed_over > 0) {
        passed_over =
            setting_line("", fmt::format("{} passed over for showing too little, or making no view",
                                         counted(comparison.advice_views.passed_over, "view")));
    }
    if (views.size() < 2 || remedy.views.size() != views.size()) {
        return passed_over;
    }
    std::string text = "\n";
    text +=
        count_line("view", "as it is", "remedy 1", error_heading(is_counted(comparison, remedy)));
    for (std::size_t i = 0; i < views.size(); ++i) {
        text += count_line(views[i].name, percent(views[i].now.error_rate()),
                           percent(remedy.views[i].error_rate()), "");
    }
    text += count_line("all", "", percent(analysis::pooled(remedy.views).error_rate()), "");
    return text + passed_over;
}

/// Formats remedies as lines: wrong pixels, the amount of error without softened borders and, for
/// fractional verdicts, the amount with them.
class RemedyLines {
public:
    RemedyLines(const analysis::Comparison& comparison, bool are_counts)
        : comparison_{comparison},
          scored_{comparison.metrics.pixels.scored()},
          are_counts_{are_counts},
          unit_{length_unit(comparison)}
    {
    }

    [[nodiscard]] std::string line(std::string_view name, const analysis::Outcome& outcome,
                                   const std::string& change) const
    {
        const std::string with_borders =
            are_counts_ ? ""
                        : pad_right(share(outcome.amounts.total()) + " with them", with_columns);
        return count_line(name, grouped(outcome.errors.total()), share(outcome.error_amount()),
                          with_borders + change);
    }
    [[nodiscard]] std::string line(std::string_view name, const analysis::Remedy& remedy) const
    {
        return line(name, remedy.outcome,
                    fmt::format("{}: {}, {}, by {}{}", remedy_keys(remedy, unit_),
                                mebibytes(remedy.cost.map_bytes),
                                counted(static_cast<std::uint64_t>(remedy.cost.taps), "tap"),
                                shown_name(analysis::measured_by_names.at(
                                    static_cast<std::size_t>(remedy.measured_by))),
                                worsening_text(comparison_, remedy)));
    }

private:
    static constexpr std::size_t with_columns = 20;

    [[nodiscard]] std::string share(double amount) const
    {
        return percent(analysis::ratio(amount, scored_));
    }

    const analysis::Comparison& comparison_;
    std::uint64_t scored_;
    bool are_counts_;
    std::string_view unit_;
};

} // namespace

std::string remedy_table(const analysis::Comparison& comparison)
{
    constexpr std::size_t most_lines = 12;
    const auto ranked = analysis::ranked_remedies(comparison);
    const auto trades = analysis::trade_offs(comparison);
    if (ranked.empty() && trades.empty()) {
        return "";
    }
    const auto& listed = ranked.empty() ? trades : ranked;
    const bool are_counts = std::ranges::all_of(
        listed, [&](const analysis::Remedy& remedy) { return is_counted(comparison, remedy); });
    const RemedyLines lines{comparison, are_counts};
    const analysis::Metrics& now = comparison.metrics;
    std::string text = "\n";
    text += count_line("remedy", "wrong px", "error", error_heading(are_counts));
    text += lines.line("the job as it is",
                       {{now.false_shadow, now.false_lit},
                        now.amounts,
                        now.amounts.total() - analysis::error_amount(comparison)},
                       "");
    for (std::size_t i = 0; i < std::min(ranked.size(), most_lines); ++i) {
        text += lines.line(fmt::format("{}", i + 1), ranked[i]);
    }
    if (ranked.size() > most_lines) {
        text += setting_line("", fmt::format("and {} more", ranked.size() - most_lines));
    }
    if (ranked.empty()) {
        return text + lines.line("a trade-off", trades.front());
    }
    return text + views(comparison, ranked.front());
}

} // namespace gnomon::reports
