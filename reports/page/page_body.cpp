#include "reports/page/page_html.hpp"

#include "reports/text/text.hpp"
#include "store/json_values.hpp"
#include "store/run/run_commands.hpp"
#include "store/run/run_status.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

std::string count_cells(const OverviewRow& overview)
{
    const store::ResultRow& row = overview.result;
    return number_cell(percent(row.number("error_rate"))) + number_cell(overview.mean_error) +
           number_cell(grouped(row.count("false_shadow"))) +
           number_cell(percent(row.number("false_shadow_rate"))) +
           number_cell(grouped(row.count("false_lit"))) +
           number_cell(percent(row.number("false_lit_rate")));
}

std::string row_name(const OverviewRow& row)
{
    return row.settings.empty() ? "this shadow map" : row.settings;
}

/// The best and the worst configuration of each case, and a fix for the best.
std::string cases_table(const store::RunReader& run, const RunOverview& overview)
{
    std::string html = "<div class=\"scroll\"><table><caption>Each case</caption>\n<thead><tr>"
                       "<th scope=\"col\">best</th><th scope=\"col\" class=\"number\">wrong</th>"
                       "<th scope=\"col\">worst</th><th scope=\"col\" class=\"number\">wrong</th>"
                       "<th scope=\"col\">fix for the best</th></tr></thead>\n<tbody>\n";
    const auto rate = [](const OverviewRow& row) {
        return number_cell(percent(row.result.number("error_rate")));
    };
    const auto text = [](const std::string& words) {
        return fmt::format("<td><bdi>{}</bdi></td>", escaped(words));
    };
    for (std::size_t i = 0; i < overview.rows.size(); ++i) {
        const OverviewRow& best = overview.rows[i];
        const OverviewRow& worst = overview.worst[i];
        const std::string fix = first_fix(store::find_detail(run.folder(), best.result.text("id")),
                                          overview.length_unit);
        html += "<tr>" + row_heading(row_name(best)) + rate(best) + text(row_name(worst)) +
                rate(worst) + text(fix) + "</tr>\n";
    }
    return html + std::string{table_end};
}

std::string headline_table(const RunOverview& overview)
{
    const char* title = overview.is_of_lights ? "Each light, the most wrong first"
                                              : "Lowest error rates, and the highest";
    std::string html = table_head(title, {"configuration", "error rate", "mean error",
                                          "false shadow", "of lit", "false lit", "of blocked"});
    for (const OverviewRow& row : overview.rows) {
        const bool is_highest =
            !overview.is_of_lights && &row == &overview.rows.back() && overview.rows.size() > 2;
        html += fmt::format("<tr{}>{}{}</tr>\n", is_highest ? " class=\"highest\"" : "",
                            row_heading((is_highest ? "highest: " : "") + row_name(row)),
                            count_cells(row));
    }
    return html + std::string{table_end};
}

std::string limit_text(const store::ResultRow& row, std::string_view column)
{
    const std::optional<double> limit = row.number(column);
    return limit ? fmt::format("{:.6g}", *limit) : std::string{"none"};
}

/// The recommended bias in other units; empty if none is recommended.
std::string recommended_text(const store::ResultRow& row, std::string_view unit)
{
    const auto metres = row.number("bias_curve.recommended.bias_m");
    const auto texels = row.number("bias_curve.recommended.bias_texels");
    const auto views = row.number("bias_curve.recommended.views");
    if (!metres || !texels || !views) {
        return {};
    }
    return fmt::format(
        "<p>The recommended bias is {:.3g} {} along the light’s axis, {:.3g} texels, "
        "at the median receiver; it is based on {}.</p>\n",
        *metres, unit, *texels, counted(static_cast<std::uint64_t>(*views), "view"));
}

/// The limits from the headline configuration's bias curve.
std::string bias_table(const store::ResultRow& row, std::string_view unit)
{
    if (row.text("bias_source") != "curve") {
        return {};
    }
    std::string html = table_head("Constant biases, in depth units", {"bias", "value"});
    for (const auto& [name, column] :
         {std::pair{"recommended", "bias_curve.recommended.bias"},
          {"nearly as good, from", "bias_curve.recommended.low"},
          {"nearly as good, to", "bias_curve.recommended.high"},
          {"fewest errors, from", "bias_curve.best_interval.lo"},
          {"fewest errors, to", "bias_curve.best_interval.hi"},
          {"smallest without acne", "bias_curve.acne_free"},
          {"largest without peter-panning", "bias_curve.peter_panning_free"},
          {"largest without false light", "bias_curve.panning_free"},
          {"largest that adds no new false light", "bias_curve.panning_free_beyond_zero"}}) {
        html += "<tr>" + row_heading(name) + number_cell(limit_text(row, column)) + "</tr>\n";
    }
    html += table_end;
    html += recommended_text(row, unit);
    return html + fmt::format("<p>The bias with the fewest wrong pixels leaves {}.</p>\n",
                              counted(row.count("bias_curve.best_errors"), "pixel"));
}

std::string failures_table(const RunOverview& overview)
{
    if (overview.failed.empty()) {
        return {};
    }
    std::string html =
        "<div class=\"scroll\"><table><caption>Configurations that failed</caption>\n"
        "<thead><tr><th scope=\"col\">configuration</th><th scope=\"col\">why</th>"
        "</tr></thead>\n<tbody>\n";
    for (const OverviewRow& row : overview.failed) {
        html += fmt::format("<tr>{}<td><bdi>{}</bdi></td></tr>\n", row_heading(row_name(row)),
                            escaped(row.result.text("message")));
    }
    html += table_end;
    if (overview.failed_count > overview.failed.size()) {
        html += fmt::format("<p>{} more failed: <code>gnomon status --all</code> lists them.</p>\n",
                            grouped(overview.failed_count - overview.failed.size()));
    }
    return html;
}

/// Notes on the scene files.
std::string notes_list(const RunOverview& overview)
{
    if (overview.notes.empty()) {
        return {};
    }
    std::string html = "<p id=\"notes-heading\">Notes on the scene:</p>\n"
                       "<ul aria-labelledby=\"notes-heading\">\n";
    for (const std::string& note : overview.notes) {
        html += fmt::format("<li><bdi>{}</bdi></li>\n", escaped(note));
    }
    return html + "</ul>\n";
}

/// The ranking of a sweep, notes on its scenes, and failures.
std::string after_the_answer(const store::RunReader& run, const RunOverview& overview)
{
    std::string html;
    if (overview.has_cases) {
        html = cases_table(run, overview);
    } else if (overview.headline && !overview.is_one) {
        html = headline_table(overview);
    }
    return html + notes_list(overview) + failures_table(overview);
}

/// All findings, one sentence a line.
std::string words_section(const RunOverview& overview)
{
    std::string html = "<section id=\"words\" data-nav=\"In words\" "
                       "aria-labelledby=\"words-heading\">\n"
                       "<h2 id=\"words-heading\">In words</h2>\n";
    for (const std::string& sentence : overview.sentences) {
        html += fmt::format("<p><bdi>{}</bdi></p>\n", escaped(sentence));
    }
    return html + "</section>\n";
}

/// The limits of the constant bias; scripts add those of other slopes.
std::string biases_section(const RunOverview& overview)
{
    const std::string table = overview.headline
                                  ? bias_table(overview.headline->result, overview.length_unit)
                                  : std::string{};
    return fmt::format("<section id=\"biases\" data-nav=\"Biases\" "
                       "aria-labelledby=\"biases-heading\"{}>\n"
                       "<h2 id=\"biases-heading\">Constant biases</h2>\n{}"
                       "<div id=\"remedies\"></div></section>\n",
                       table.empty() ? " hidden" : "", table);
}

/// Empty if no figure was asked for.
std::string figures_section(const ReportOptions& options, std::span<const std::string> pictures)
{
    if (pictures.empty() && options.no_figures.empty()) {
        return {};
    }
    std::string html = "<section id=\"figures\" data-nav=\"Figures\" "
                       "aria-labelledby=\"figures-heading\">\n"
                       "<h2 id=\"figures-heading\">Figures</h2>\n";
    if (!options.no_figures.empty()) {
        html += fmt::format("<p>{}</p>\n", escaped(options.no_figures));
    }
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const ReportFigure& figure = options.figures[i];
        html += fmt::format("<figure><img src=\"{}\" alt=\"{}\" loading=\"lazy\">"
                            "<figcaption><strong>{}</strong> {}</figcaption></figure>\n",
                            pictures[i], escaped(figure.alt), escaped(figure.title),
                            escaped(figure.caption));
    }
    return html + "</section>\n";
}

/// An empty section for scripts to fill.
/// @param nav  its name in the bar of sections.
std::string script_section(std::string_view id, std::string_view nav, std::string_view heading)
{
    return fmt::format("<section id=\"{0}\" data-nav=\"{1}\" aria-labelledby=\"{0}-heading\" "
                       "hidden>\n<h2 id=\"{0}-heading\">{2}</h2>\n</section>\n",
                       id, nav, heading);
}

std::string counts_table(std::string_view caption, const store::ResultRow& row,
                         const std::vector<KindColumns>& columns)
{
    const std::uint64_t all = row.count("false_shadow") + row.count("false_lit");
    const bool with_amounts = has_amounts(row);
    std::string html = with_amounts
                           ? table_head(caption, {"name", "pixels", "of wrong", "amount [px]"})
                           : table_head(caption, {"name", "pixels", "of wrong"});
    for (const auto& [count_column, amount_column, name] : columns) {
        const std::uint64_t count = row.count(count_column);
        html +=
            "<tr>" + row_heading(name) + number_cell(grouped(count)) +
            number_cell(all == 0 ? std::string{"-"}
                                 : percent(static_cast<double>(count) / static_cast<double>(all))) +
            (with_amounts ? number_cell(grouped_amount(row.number(amount_column).value_or(0)))
                          : std::string{}) +
            "</tr>\n";
    }
    return html + std::string{table_end};
}

std::string kinds_tables(const store::ResultRow& row)
{
    if (!has_causes(row)) {
        return fmt::format("<p>{}</p>\n", causes_not_known);
    }
    return counts_table("By cause", row, cause_columns()) +
           counts_table("By name", row, label_columns());
}

std::string objects_section(const RunOverview& overview)
{
    constexpr std::string_view title = "Where and why";
    if (!overview.headline) {
        return script_section("objects", title, title);
    }
    const OverviewRow& row = *overview.headline;
    return fmt::format("<section id=\"objects\" data-nav=\"{0}\" "
                       "aria-labelledby=\"objects-heading\">\n"
                       "<h2 id=\"objects-heading\">{0}</h2>\n"
                       "<p id=\"objects-of\">For <bdi>{1}</bdi>.</p>\n",
                       title, escaped(row_name(row))) +
           kinds_tables(row.result) + objects_table(overview.detail) +
           maps_table(overview.detail, overview.length_unit) + "</section>\n";
}

std::string definition(std::string_view term, std::string_view text)
{
    return fmt::format("<dt>{}</dt><dd><bdi>{}</bdi></dd>\n", escaped(term), escaped(text));
}

/// The list to choose a configuration from.
std::string_view best_words(const RunOverview& overview)
{
    if (overview.has_cases) {
        return " (the best of the first case)";
    }
    return overview.rows.size() > 1 ? " (the best)" : "";
}

std::string environment_section(const store::RunReader& run, const RunOverview& overview)
{
    const store::RunDescription& description = run.description();
    const analysis::Environment& environment = description.environment;
    std::string html =
        "<section id=\"environment\" data-nav=\"Settings\" aria-labelledby=\"environment-heading\">"
        "\n<h2 id=\"environment-heading\">Settings, and how to repeat the run</h2>\n<dl>\n";
    html += definition(environment.is_of_gl() ? "GL" : "renderer", environment.gl_renderer) +
            (environment.is_of_gl() ? definition("GL version", environment.gl_version) : "") +
            definition("ray tracer", environment.embree) +
            definition("gnomon", environment.gnomon) + "</dl>\n";
    html += fmt::format("<p>The whole run:</p>\n<pre><code>{} --out RUN\ngnomon report RUN</code>"
                        "</pre>\n",
                        escaped(store::run_command(description)));
    if (overview.headline) {
        const std::string command = store::compare_command(description, overview.headline->result);
        html += command.empty()
                    ? std::string{}
                    : fmt::format("<p>One configuration{}:</p>\n<pre><code>{}</code>"
                                  "</pre>\n<h3>Its job settings</h3>\n<dl class=\"job\">\n",
                                  best_words(overview), escaped(command));
        for (const auto& [key, value] : store::job_settings(overview.headline->result)) {
            html += definition(key, value);
        }
        html += "</dl>\n";
    }
    return html + "</section>\n";
}

/// The bar of sections. Scripts add those that they fill.
std::string navigation(const RunOverview& overview)
{
    const std::string_view fix = overview.detail.is_null() ? "" : "<a href=\"#fix\">Fix</a>";
    return fmt::format("<nav class=\"sections\" aria-label=\"Sections\"><a class=\"home\" "
                       "href=\"#answer\">Gnomon</a><span class=\"links\">{}<a href=\"#objects\">"
                       "Where and why</a><a href=\"#environment\">Settings</a></span></nav>\n",
                       fix);
}

} // namespace

std::string page_body(const store::RunReader& run, const RunOverview& overview,
                      const ReportOptions& options, const PageParts& parts)
{
    return fmt::format("<body data-length-unit=\"{}\">\n", overview.length_unit) +
           "<a class=\"skip\" href=\"#answer\">To the answer</a>\n" + navigation(overview) +
           "<main>\n" +
           first_screen(run, overview, parts.headline, after_the_answer(run, overview)) +
           parts.against + script_section("inspector", "Pixels", "Pixel by pixel") +
           biases_section(overview) +
           script_section("distance", "Distance", "By distance from the light") +
           script_section("slope", "Slope", "By the receiver's slope") +
           script_section("sweep", "Configurations", "All configurations") +
           words_section(overview) + objects_section(overview) +
           figures_section(options, parts.figures) + environment_section(run, overview) +
           "<noscript><p>With JavaScript, this page also shows every pixel, every bias and every "
           "configuration.</p></noscript>\n</main>\n";
}

} // namespace gnomon::reports
