#include "reports/page/json_members.hpp"
#include "reports/page/page_html.hpp"
#include "reports/text/text.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/json_values.hpp"

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
    std::string headline = text_of(overview.detail, "headline");
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

} // namespace

std::string first_screen(const store::RunReader& run, const RunOverview& overview,
                         std::span<const HeadlinePicture> pictures, const std::string& below)
{
    return fmt::format(
               "<section id=\"answer\" data-nav=\"Answer\" aria-labelledby=\"answer-heading\">"
               "\n<h1 id=\"answer-heading\">{}</h1>\n",
               with_marked_number(heading(run, overview))) +
           lead(run, overview) + counts(overview) + strip(overview, pictures) +
           (overview.detail.is_null() ? std::string{} : fix_cards(run, overview)) + below +
           "</section>\n";
}

} // namespace gnomon::reports
