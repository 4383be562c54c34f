#include "reports/page/json_members.hpp"
#include "reports/page/page_html.hpp"
#include "reports/settings/settings_text.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"
#include "store/run/run_commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using store::Json;

constexpr std::size_t most_ways = 6; ///< remedies in the table

/// "a constant bias of 0.078 m (4.8 texels)", or the keys.
std::string remedy_name(const Json& remedy, std::string_view unit)
{
    const std::vector<std::string> keys = texts_of(remedy, "keys");
    const auto metres = number_of(remedy, "bias_m");
    const auto texels = number_of(remedy, "bias_texels");
    const std::string length = metres && texels && *metres > 0
                                   ? fmt::format("{:.3g} {}, {:.3g} texels", *metres, unit, *texels)
                                   : std::string{};
    if (keys.size() == 1 && keys.front().starts_with("bias.constant") && !length.empty()) {
        return "a constant bias of " + length;
    }
    return fmt::format("{}{}", fmt::join(keys, ", "),
                       length.empty() ? "" : fmt::format(" ({})", length));
}

double scored(const Json& detail)
{
    const Json* const pixels = member(detail, "pixels");
    return pixels == nullptr
               ? 0
               : number_of(*pixels, "lit").value_or(0) + number_of(*pixels, "blocked").value_or(0);
}

/// What a remedy or the job itself leaves wrong, by amount, of the scored pixels.
std::string left_wrong(const Json& of, const Json& detail)
{
    const double all = scored(detail);
    const auto amount = number_of(of, "error_amount");
    return amount && all > 0 ? percent(*amount / all) : "-";
}

/// " by amount" where amounts differ from counts of pixels.
std::string_view by_amount(const RunOverview& overview)
{
    return overview.headline && has_amounts(overview.headline->result) ? " by amount" : "";
}

/// A text to paste, with the place for a button that copies it.
std::string panel(std::string_view name, std::string_view title, std::string_view text,
                  const std::string& below)
{
    return fmt::format("<div class=\"panel\" data-name=\"{}\" data-title=\"{}\"><h3>{}</h3>\n"
                       "<pre><code>{}</code></pre>\n{}</div>\n",
                       escaped(name), escaped(title), escaped(title), escaped(text), below);
}

std::string engine_panel(const Json& engine)
{
    const std::string title = text_of(engine, "title");
    const std::vector<std::string> cannot = texts_of(engine, "cannot");
    const bool is_recommended =
        member(engine, "recommended") != nullptr && engine["recommended"] == true;
    const std::string rates = error_rates_text(number_of(engine, "false_shadow_rate"),
                                               number_of(engine, "false_lit_rate"));
    const std::string version = text_of(engine, "version"); // languages and APIs have none
    std::string below = fmt::format(
        "<p class=\"hint\">{}{}{}, with {}: {}.", escaped(title), version.empty() ? "" : " ",
        escaped(version), is_recommended ? "the recommended bias" : "the job’s own bias",
        rates.empty() ? "the errors are not known, for a bias is missing" : rates);
    if (!cannot.empty()) {
        below +=
            fmt::format(" Not expressed: {}.", escaped(fmt::format("{}", fmt::join(cannot, "; "))));
    }
    return panel(text_of(engine, "engine"), title, text_of(engine, "text"), below + "</p>\n");
}

/// "0.064 m (3.94 texels)": an end of the recommended bias's range.
std::string range_end(const Json& recommended, std::string_view end, std::string_view unit)
{
    const auto metres = number_of(recommended, fmt::format("{}_m", end));
    const auto texels = number_of(recommended, fmt::format("{}_texels", end));
    return metres && texels ? fmt::format("{:.3g} {} ({:.3g} texels)", *metres, unit, *texels)
                            : std::string{};
}

/// "Nearly as good: 0.064 m (3.94 texels) to 0.096 m (5.91 texels)."
std::string safe_range(const Json& recommended, std::string_view unit)
{
    const std::string low = number_of(recommended, "low").value_or(0) > 0
                                ? range_end(recommended, "low", unit)
                                : std::string{"0"};
    const std::string high = range_end(recommended, "high", unit);
    return high.empty() ? fmt::format("Nearly as good: all from {} on.", low)
                        : fmt::format("Nearly as good: {} to {}.", low, high);
}

/// The safe range of the recommended bias, and its cost where things touch.
std::string fix_notes(const RunOverview& overview)
{
    const Json* const curve = member(overview.detail, "bias_curve");
    const Json* const recommended = curve == nullptr ? nullptr : member(*curve, "recommended");
    const std::vector<std::string> sentences =
        recommended == nullptr ? std::vector<std::string>{} : texts_of(*recommended, "sentences");
    if (sentences.size() < 2) {
        return {};
    }
    std::string html = safe_range(*recommended, overview.length_unit);
    for (std::size_t i = 1; i < sentences.size(); ++i) { // the first gives the range in depth units
        html += fmt::format(" <bdi>{}</bdi>", escaped(sentences[i]));
    }
    return fmt::format("<p class=\"hint\">{}</p>\n", html);
}

/// What is known in place of a remedy, and the command that measures more.
std::string without_remedy(const store::RunReader& run, const RunOverview& overview)
{
    const std::vector<std::string> findings = texts_of(overview.detail, "findings");
    const bool was_advised = !list_of(overview.detail, "advice").empty();
    if (was_advised) {
        return findings.size() < 2 ? std::string{}
                                   : fmt::format("<p><bdi>{}</bdi></p>\n", escaped(findings[1]));
    }
    const std::string command =
        store::compare_command(run.description(), overview.headline->result);
    return command.starts_with("gnomon compare ") && !findings.empty()
               ? fmt::format("<p>This command measures what cures the errors:</p>\n"
                             "<pre><code>{} --advise</code></pre>\n",
                             escaped(command))
               : std::string{};
}

std::string fix_heading(const RunOverview& overview, const std::vector<Json>& remedies)
{
    const Json& detail = overview.detail;
    if (!remedies.empty()) {
        return fmt::format("Fix: {} <span class=\"good\">→ {} wrong{}</span> (from {})",
                           escaped(remedy_name(remedies.front(), overview.length_unit)),
                           left_wrong(remedies.front(), detail), by_amount(overview),
                           left_wrong(detail, detail));
    }
    const double wrong = overview.headline->result.number("error_rate").value_or(0);
    if (number_of(detail, "error_amount").value_or(wrong) == 0) {
        return "Nothing to fix";
    }
    if (!number_of(detail, "error_amount")) {
        return "No fix is known, because the causes are not";
    }
    return list_of(detail, "advice").empty() ? "No bias alone helps"
                                             : "No change that was tried helps";
}

/// Whether the fix is the constant bias whose range is known.
bool is_constant_bias(const std::vector<Json>& remedies)
{
    const std::vector<std::string> keys =
        remedies.empty() ? std::vector<std::string>{} : texts_of(remedies.front(), "keys");
    return keys.size() == 1 && keys.front().starts_with("bias.constant");
}

std::string fix_card(const store::RunReader& run, const RunOverview& overview)
{
    const Json& detail = overview.detail;
    const std::vector<Json> remedies = list_of(detail, "remedies");
    std::string html = fmt::format("<section class=\"card\" id=\"fix\" data-nav=\"Fix\" "
                                   "aria-labelledby=\"fix-heading\">\n<h2 id=\"fix-heading\">{}"
                                   "</h2>\n",
                                   fix_heading(overview, remedies));
    std::string panels = remedies.empty()
                             ? std::string{}
                             : panel("gnomon", "Gnomon", text_of(remedies.front(), "toml"), "");
    for (const Json& engine : list_of(detail, "engine_settings")) {
        panels += engine_panel(engine);
    }
    const bool is_wrong = overview.headline->result.number("error_rate").value_or(0) > 0;
    html += remedies.empty() && is_wrong ? without_remedy(run, overview) : std::string{};
    html += panels.empty() ? panels : "<div class=\"panels\">\n" + panels + "</div>\n";
    return html + (is_constant_bias(remedies) ? fix_notes(overview) : std::string{}) +
           "</section>\n";
}

std::string way_row(std::string_view css, const std::string& name, const std::string& wrong,
                    const std::string& memory, const std::string& reads)
{
    return fmt::format("<tr class=\"{}\">{}{}{}{}</tr>\n", css, row_heading(name),
                       number_cell(wrong), number_cell(memory), number_cell(reads));
}

std::string ways_card(const RunOverview& overview)
{
    const Json& detail = overview.detail;
    const std::vector<Json> remedies = list_of(detail, "remedies");
    if (remedies.empty()) {
        return {};
    }
    std::string html =
        "<section class=\"card\" id=\"ways\" aria-labelledby=\"ways-heading\">\n<h2 "
        "id=\"ways-heading\">Ways to fix it</h2>\n" +
        table_head("", {"change", by_amount(overview).empty() ? "wrong" : "wrong by amount",
                        "memory", "reads"}) +
        way_row("now", "as it is", left_wrong(detail, detail), "", "");
    for (std::size_t i = 0; i < std::min(remedies.size(), most_ways); ++i) {
        const Json& remedy = remedies[i];
        const auto count = [&](const char* name) {
            return static_cast<std::uint64_t>(number_of(remedy, name).value_or(0));
        };
        html += way_row(i == 0 ? "best" : "", remedy_name(remedy, overview.length_unit),
                        left_wrong(remedy, detail), mebibytes(count("map_bytes")),
                        grouped(count("taps")));
    }
    return html + std::string{table_end} +
           "<p class=\"hint\">The cheapest change that cures most comes first.</p>\n</section>\n";
}

} // namespace

std::string first_fix(const Json& detail, std::string_view unit)
{
    const std::vector<Json> remedies = list_of(detail, "remedies");
    return remedies.empty() ? std::string{}
                            : fmt::format("{} → {} wrong", remedy_name(remedies.front(), unit),
                                          left_wrong(remedies.front(), detail));
}

std::string fix_cards(const store::RunReader& run, const RunOverview& overview)
{
    return "<div class=\"two\">\n" + fix_card(run, overview) + ways_card(overview) + "</div>\n";
}

} // namespace gnomon::reports
