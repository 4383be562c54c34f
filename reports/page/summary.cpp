#include "reports/page/run_overview.hpp"

#include "reports/page/json_members.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"
#include "store/run/run_commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::reports {

namespace {

constexpr std::size_t longest_text = 1000;

/// A code block whose fence is longer than any in the text.
std::string code_block(const std::string& text)
{
    std::string fence = "```";
    while (text.find(fence) != std::string::npos) {
        fence += '`';
    }
    return fmt::format("{0}sh\n{1}\n{0}\n", fence, text);
}

std::string table(const RunOverview& overview)
{
    std::string text =
        "| configuration | false shadow | of lit | false lit | of blocked | error rate "
        "| mean error |\n|---|---:|---:|---:|---:|---:|---:|\n";
    for (const OverviewRow& row : overview.rows) {
        const bool is_highest = !overview.has_cases && !overview.is_of_lights &&
                                &row == &overview.rows.back() && overview.rows.size() > 2;
        text += fmt::format(
            "| {}{} | {} | {} | {} | {} | {} | {} |\n", is_highest ? "highest: " : "",
            row.settings.empty() ? "this shadow map" : markdown_text(row.settings),
            grouped(row.result.count("false_shadow")),
            percent(row.result.number("false_shadow_rate")), grouped(row.result.count("false_lit")),
            percent(row.result.number("false_lit_rate")), percent(row.result.number("error_rate")),
            row.mean_error);
    }
    return text + "\n";
}

std::string counts(const store::ResultRow& row)
{
    if (!has_causes(row)) {
        return fmt::format("{}\n\n", causes_not_known);
    }
    std::string text;
    for (const auto* const columns : {&cause_columns(), &label_columns()}) {
        text += columns == &cause_columns() ? "By cause: " : "By name: ";
        bool is_first = true;
        for (const auto& [count, amount, name] : *columns) {
            text += fmt::format("{}{} {}", is_first ? "" : ", ", name, grouped(row.count(count)));
            if (has_amounts(row)) {
                text += fmt::format(" ({} px by amount)",
                                    grouped_amount(row.number(amount).value_or(0)));
            }
            is_first = false;
        }
        text += ".\n\n";
    }
    return text;
}

std::string remedy_row(const store::Json& remedy)
{
    const auto count = [&](const char* name) {
        return static_cast<std::uint64_t>(number_of(remedy, name).value_or(0));
    };
    return fmt::format("| {} | {} | {} | {} | {} |\n",
                       markdown_text(fmt::format("{}", fmt::join(texts_of(remedy, "keys"), ", "))),
                       grouped(count("false_shadow") + count("false_lit")),
                       mebibytes(count("map_bytes")), grouped(count("taps")),
                       markdown_text(text_of(remedy, "measured_by")));
}

/// The first remedies for the headline configuration; empty without any.
std::string remedies(const store::Json& detail)
{
    constexpr std::size_t most_lines = 5;
    const std::vector<store::Json> ranked = list_of(detail, "remedies");
    if (ranked.empty()) {
        return {};
    }
    std::string text = "| remedy | wrong pixels | map | texels read | known from |\n"
                       "|---|---:|---:|---:|---|\n";
    for (std::size_t i = 0; i < std::min(ranked.size(), most_lines); ++i) {
        text += remedy_row(ranked[i]);
    }
    return text + "\n";
}

/// The pictures side by side.
std::string picture_table(std::span<const HeadlinePicture> pictures)
{
    if (pictures.size() != 3) {
        return {};
    }
    std::string text = "| drawn | true | wrong |\n|---|---|---|\n|";
    for (const HeadlinePicture& picture : pictures) {
        text += fmt::format(" ![{}]({}) |", markdown_text(picture.alt), picture.file);
    }
    return text + "\n\n";
}

} // namespace

std::string markdown_text(std::string_view text)
{
    constexpr std::string_view with_backslash = "\\`*_{}[]<>#!|~$";
    std::string_view shown = first_columns(text, longest_text);
    if (shown.size() < text.size()) {
        shown = shown.substr(0, shown.rfind(' ')); // keep a text without blanks
    }
    std::string markdown;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const char c = shown[i];
        const bool begins_a_word = i + 1 < shown.size() && shown[i + 1] != ' ';
        if (static_cast<unsigned char>(c) < ' ') {
            markdown += ' ';
        } else if (c == '&' || c == '@' || (c == ':' && begins_a_word)) {
            // A character reference, a mention, an address or an emoji's name.
            markdown += fmt::format("&#{};", static_cast<int>(c));
        } else {
            markdown += with_backslash.find(c) != std::string_view::npos ? "\\" : "";
            markdown += c;
        }
    }
    return markdown + (shown.size() < text.size() ? "…" : "");
}

namespace {

std::string environment_line(const analysis::Environment& environment)
{
    const std::string version =
        environment.is_of_gl() ? markdown_text(environment.gl_version) + ", " : "";
    return fmt::format("{}, {}{}, gnomon {}\n\n", markdown_text(environment.gl_renderer), version,
                       markdown_text(environment.embree), markdown_text(environment.gnomon));
}

} // namespace

std::string summary_text(const store::RunReader& run, const RunOverview& overview,
                         const ReportOptions& options, std::span<const HeadlinePicture> pictures)
{
    std::string text =
        fmt::format("# Shadow-map accuracy: {}\n\n",
                    overview.scene.empty() ? "several scenes" : markdown_text(overview.scene));
    for (const std::string& sentence : overview.sentences) {
        text += markdown_text(sentence) + "\n";
    }
    text += "\n";
    for (const std::string& note : overview.notes) {
        text += fmt::format("- note: {}\n", markdown_text(note));
    }
    text += overview.notes.empty() ? "" : "\n";
    text += picture_table(pictures);
    if (overview.headline) {
        text += table(overview);
        if (overview.rows.size() > 1) {
            text += overview.has_cases
                        ? fmt::format("Of the best of case {}:\n\n",
                                      markdown_text(overview.headline->result.text("case")))
                        : "Of the best:\n\n";
        }
        text += counts(overview.headline->result);
        text += remedies(overview.detail);
    }
    for (const OverviewRow& row : overview.failed) {
        text += fmt::format("- failed: {}: {}\n", markdown_text(row.settings),
                            markdown_text(row.result.text("message")));
    }
    text += overview.failed.empty() ? "" : "\n";
    text += overview.has_cases && !options.figures.empty() ? "Of all cases:\n\n" : "";
    for (const ReportFigure& figure : options.figures) {
        text += fmt::format("![{}](figures/{})\n\n", markdown_text(figure.alt), figure.png);
    }
    text += "Every pixel, bias and configuration: [report.html](report.html). The numbers: "
            "[results.csv](results.csv), [error_vs_z.csv](error_vs_z.csv), "
            "[bias_curves.csv](bias_curves.csv).\n\n";
    return text + environment_line(run.description().environment) +
           code_block(store::run_command(run.description()) + " --out RUN\ngnomon report RUN");
}

} // namespace gnomon::reports
