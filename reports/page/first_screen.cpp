#include "reports/page/page_html.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/json_values.hpp"
#include "store/run/run_commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

using store::Json;

constexpr std::size_t most_ways = 6; ///< remedies in the table

// The JSON may come from anywhere: a member of another type reads as missing.

const Json* member(const Json& object, std::string_view name)
{
    const auto found = object.is_object() ? object.find(name) : object.end();
    return found == object.end() || found->is_null() ? nullptr : &*found;
}

std::optional<double> number_of(const Json& object, std::string_view name)
{
    const Json* const found = member(object, name);
    return found != nullptr && found->is_number() ? std::optional{found->get<double>()}
                                                  : std::nullopt;
}

std::string text_of(const Json& object, std::string_view name)
{
    const Json* const found = member(object, name);
    return found != nullptr && found->is_string() ? found->get<std::string>() : std::string{};
}

/// An array's elements; none if there is no such array.
std::vector<Json> list_of(const Json& object, std::string_view name)
{
    const Json* const found = member(object, name);
    return found != nullptr && found->is_array() ? std::vector<Json>{found->begin(), found->end()}
                                                 : std::vector<Json>{};
}

std::vector<std::string> texts_of(const Json& object, std::string_view name)
{
    std::vector<std::string> texts;
    for (const Json& element : list_of(object, name)) {
        if (element.is_string()) {
            texts.push_back(element.get<std::string>());
        }
    }
    return texts;
}

/// Marks the number that a heading begins with: "<span>0.78 %</span> of the lit surface …".
std::string with_marked_number(const std::string& text)
{
    const std::size_t end = text.find(" %");
    const bool has_number = !text.empty() &&
                            std::isdigit(static_cast<unsigned char>(text.front())) != 0 &&
                            end != std::string::npos;
    return has_number ? fmt::format("<span class=\"bad\">{}</span>{}",
                                    escaped(text.substr(0, end + 2)), escaped(text.substr(end + 2)))
                      : escaped(text);
}

std::string scored_rate(const store::ResultRow& row)
{
    return percent(row.number("error_rate"));
}

/// What is wrong, of one comparison.
std::string comparison_heading(const RunOverview& overview)
{
    const std::string headline = text_of(overview.detail, "headline");
    if (!headline.empty()) {
        return headline;
    }
    const store::ResultRow& row = overview.headline->result;
    return row.number("error_rate")
               ? fmt::format("{} of the scored pixels are wrong", scored_rate(row))
               : std::string{"No pixel was scored"};
}

/// "0.24 % to 0.62 % wrong with the best of each of 2 cases"
std::string cases_heading(const RunOverview& overview, std::size_t cases)
{
    const auto rate = [](const OverviewRow& row) {
        return row.result.number("error_rate").value_or(0);
    };
    const auto [least, most] = std::ranges::minmax(overview.rows, {}, rate);
    return fmt::format("{} to {} wrong with the best of each of {}", scored_rate(least.result),
                       scored_rate(most.result), counted(cases, "case"));
}

std::string heading(const store::RunReader& run, const RunOverview& overview)
{
    if (!overview.headline) {
        return "Nothing was measured yet";
    }
    if (overview.is_one || overview.is_of_lights) {
        return comparison_heading(overview);
    }
    if (overview.has_cases) {
        return cases_heading(overview, measured_cases(run).size());
    }
    const std::string best = scored_rate(overview.rows.front().result);
    const std::string worst = scored_rate(overview.rows.back().result);
    return overview.rows.size() < 2
               ? fmt::format("{} wrong with each configuration", best)
               : fmt::format("{} wrong with the best of {}, {} with the worst", best,
                             counted(run.outcome().done, "configuration"), worst);
}

/// "bias.constant_m = 0.03": the biases that are not 0; empty if the job names no bias.
std::string biases_of(const Json& job)
{
    std::vector<std::string> biases;
    bool has_keys = false;
    for (const auto& [key, value] : job.items()) {
        const bool is_bias = key.starts_with("bias.") && value.is_number();
        has_keys = has_keys || is_bias;
        if (is_bias && value.get<double>() != 0) {
            biases.push_back(fmt::format("{} = {:.3g}", key, value.get<double>()));
        }
    }
    return biases.empty() && has_keys ? "no bias" : fmt::format("{}", fmt::join(biases, ", "));
}

/// "engine.bias = 0.4": an engine's own keys.
std::string engine_keys_of(const Json& job)
{
    std::vector<std::string> keys;
    for (const auto& [key, value] : job.items()) {
        if (key.starts_with("engine.")) {
            keys.push_back(fmt::format("{} = {}", key, value.dump()));
        }
    }
    return fmt::format("{}", fmt::join(keys, ", "));
}

/// The configuration in one line: "columns · directional light · 2048² d24, nearest · …".
std::vector<std::string> settings_words(const RunOverview& overview)
{
    std::vector<std::string> words;
    const auto add = [&](std::string text) {
        if (!text.empty()) {
            words.push_back(std::move(text));
        }
    };
    add(overview.scene);
    const Json* const job = member(overview.detail, "job");
    if (job == nullptr) {
        return words;
    }
    const std::string light = text_of(*job, "light.type");
    add(light.empty() ? "" : fmt::format("{} light", light));
    const auto texels = number_of(*job, "shadow_map.resolution");
    const std::string method = text_of(*job, "method.name");
    const std::string filter = text_of(*job, "lookup.filter");
    add(texels ? fmt::format("{} map of {:.0f}² {}", method, *texels,
                             text_of(*job, "shadow_map.depth_format"))
               : method);
    add(filter.empty() ? "" : fmt::format("filter {}", filter));
    add(biases_of(*job));
    add(engine_keys_of(*job));
    const auto width = number_of(*job, "image.width");
    const auto height = number_of(*job, "image.height");
    add(width && height ? fmt::format("{:.0f} × {:.0f} pixels", *width, *height) : "");
    return words;
}

/// Which configuration the first screen shows: "The best: "; empty if the run has only one.
std::string whose(const RunOverview& overview)
{
    if (!overview.headline || overview.is_one) {
        return {};
    }
    const store::ResultRow& row = overview.headline->result;
    if (overview.is_of_lights) {
        return fmt::format("Light <bdi>{}</bdi>, the most wrong of {}: ",
                           escaped(row.text(scene::light_distinction)), overview.rows.size());
    }
    return overview.has_cases
               ? fmt::format("Shown: the best of case <bdi>{}</bdi>: ", escaped(row.text("case")))
               : fmt::format("The best, <bdi>{}</bdi>: ", escaped(overview.headline->settings));
}

std::string lead(const store::RunReader& run, const RunOverview& overview)
{
    std::vector<std::string> words = settings_words(overview);
    words.push_back(run.description().environment.gl_renderer);
    std::string html;
    for (const std::string& word : words) {
        html += fmt::format("{}<bdi>{}</bdi>", html.empty() ? "" : " · ", escaped(word));
    }
    return fmt::format("<p class=\"lead\">{}{} · <a href=\"#environment\">all settings</a></p>\n",
                       whose(overview), html);
}

std::string counts(const RunOverview& overview)
{
    if (!overview.headline) {
        return {};
    }
    const store::ResultRow& row = overview.headline->result;
    return fmt::format(
        "<p class=\"lead\">In all {} of the scored pixels are wrong: {} of {} lit pixels are "
        "shadowed, and {} of {} shadowed pixels are lit.</p>\n",
        scored_rate(row), grouped(row.count("false_shadow")), grouped(row.count("pixels.lit")),
        grouped(row.count("false_lit")), grouped(row.count("pixels.blocked")));
}

std::string strip(const RunOverview& overview, std::span<const HeadlinePicture> pictures)
{
    if (pictures.size() != 3 || !overview.headline) {
        return {};
    }
    const store::ResultRow& row = overview.headline->result;
    const std::string errors =
        fmt::format("<span class=\"false-shadow\">■</span> {} shadowed <span "
                    "class=\"false-lit\">■</span> {} lit",
                    grouped(row.count("false_shadow")), grouped(row.count("false_lit")));
    return "<div class=\"strip\">\n" + picture_figure(pictures[0], "Drawn", "with the shadow map") +
           picture_figure(pictures[1], "True", "exact shadow rays") +
           picture_figure(pictures[2], fmt::format("Wrong: {}", scored_rate(row)), errors) +
           "</div>\n";
}

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

/// "shadows 0.26 % of the lit pixels and lights 1.85 % of the shadowed ones"
std::string rates_of(const Json& engine)
{
    const auto shadowed = number_of(engine, "false_shadow_rate");
    const auto lit = number_of(engine, "false_lit_rate");
    if (!shadowed && !lit) {
        return "the errors are not known, for a bias is missing";
    }
    std::vector<std::string> parts;
    if (shadowed) {
        parts.push_back(fmt::format("shadows {} of the lit pixels", percent(shadowed)));
    }
    if (lit) {
        parts.push_back(fmt::format("lights {} of the shadowed ones", percent(lit)));
    }
    return fmt::format("{}", fmt::join(parts, " and "));
}

std::string engine_panel(const Json& engine)
{
    const std::string title = text_of(engine, "title");
    const std::vector<std::string> cannot = texts_of(engine, "cannot");
    const bool is_recommended =
        member(engine, "recommended") != nullptr && engine["recommended"] == true;
    const std::string version = text_of(engine, "version"); // languages and APIs have none
    std::string below = fmt::format("<p class=\"hint\">{}{}{}, with {}: {}.", escaped(title),
                                    version.empty() ? "" : " ", escaped(version),
                                    is_recommended ? "the recommended bias" : "the job’s own bias",
                                    rates_of(engine));
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

std::string first_screen(const store::RunReader& run, const RunOverview& overview,
                         std::span<const HeadlinePicture> pictures, const std::string& below)
{
    return fmt::format(
               "<section id=\"answer\" data-nav=\"Answer\" aria-labelledby=\"answer-heading\">"
               "\n<h1 id=\"answer-heading\">{}</h1>\n",
               with_marked_number(heading(run, overview))) +
           lead(run, overview) + counts(overview) + strip(overview, pictures) +
           (overview.detail.is_null() ? std::string{}
                                      : "<div class=\"two\">\n" + fix_card(run, overview) +
                                            ways_card(overview) + "</div>\n") +
           below + "</section>\n";
}

} // namespace gnomon::reports
