#include "reports/tables/tune_report.hpp"

#include "reports/tables/graphics_api_states.hpp"
#include "reports/tables/method_ranking_table.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/words/findings.hpp"
#include "reports/words/remedy_words.hpp"
#include "reports/words/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace gnomon::reports {

namespace {

using analysis::TunedSetting;
using analysis::TuneLimits;
using analysis::TuneResult;
using analysis::ViewOutcome;

/// Maps that differ only in slope, offset and bias share a line: the best of them.
std::vector<const TunedSetting*> best_of_each_map(const TuneResult& result)
{
    using Key = std::tuple<int, std::string, std::string, std::optional<double>,
                           std::optional<double>, scene::Cull, scene::Filter>;
    std::map<Key, std::size_t> lines;
    std::vector<const TunedSetting*> best;
    for (const TunedSetting& setting : result.considered) {
        const scene::FrustumSettings& frustum = setting.map.frustum;
        const Key key{setting.map.resolution_texels,
                      scene::depth_format_name(setting.map.depth_format),
                      shape_text(setting),
                      frustum.near_m,
                      frustum.far_m,
                      setting.map.cull,
                      setting.filter};
        const auto [line, is_new] = lines.try_emplace(key, best.size());
        if (is_new) {
            best.push_back(&setting);
        } else if (analysis::is_better(setting, *best[line->second])) {
            best[line->second] = &setting;
        }
    }
    return best;
}

/// "auto", or "0.5 to 10".
std::string range(const scene::FrustumSettings& frustum)
{
    const auto plane = [](const std::optional<double>& plane_m) {
        return plane_m ? fmt::format("{:.4g}", *plane_m) : std::string{"auto"};
    };
    return frustum.near_m || frustum.far_m
               ? fmt::format("{} to {}", plane(frustum.near_m), plane(frustum.far_m))
               : "auto";
}

/// Columns of the table for `shape_text`.
int shape_width(const TunedSetting& setting)
{
    return has_cascades(setting) ? 26 : 8;
}

std::string table_line(const TunedSetting& setting)
{
    const ViewOutcome pooled = setting.pooled();
    return fmt::format("{:<11}{:<{}}{:<13}{:<7}{:<10}{:>10}{:>12.4g}{:>11.4g}{:>8.3g}{:>14}{:>12}  "
                       "{}\n",
                       map_name(setting), shape_text(setting), shape_width(setting),
                       range(setting.map.frustum), scene::cull_name(setting.map.cull),
                       filter_text(setting), mebibytes(setting.cost.map_bytes),
                       setting.bias.constant(), setting.slope, setting.normal_texels,
                       percent(pooled.shadow_rate()), percent(pooled.light_rate()),
                       setting.meets_limits() ? "met" : "-");
}

std::string table(const TuneResult& result, TuneDetail detail)
{
    std::string text =
        fmt::format("{:<11}{:<{}}{:<13}{:<7}{:<10}{:>10}{:>12}{:>11}{:>8}{:>14}{:>12}  {}\n", "map",
                    has_cascades(result.best()) ? "cascades" : "fit", shape_width(result.best()),
                    "near, far", "cull", "filter", "memory", "constant", "slope", "offset",
                    "false shadow", "false lit", "limits");
    if (detail == TuneDetail::tried) {
        for (const TunedSetting& setting : result.considered) {
            text += table_line(setting);
        }
        return text;
    }
    for (const TunedSetting* setting : best_of_each_map(result)) {
        text += table_line(*setting);
    }
    return text;
}

/// "; by count false lit at most 1 %": of the limits that are some.
std::string counts_asked(const TuneLimits& limits)
{
    std::vector<std::string> asked;
    if (limits.max_false_shadow_rate < 1) {
        asked.push_back(
            fmt::format("false shadow at most {}", percent(limits.max_false_shadow_rate)));
    }
    if (limits.max_false_lit_rate < 1) {
        asked.push_back(fmt::format("false lit at most {}", percent(limits.max_false_lit_rate)));
    }
    return asked.empty() ? "" : fmt::format("; by count {}", fmt::join(asked, ", "));
}

std::string verdict(const TuneResult& result, const TuneLimits& limits)
{
    const std::string asked = fmt::format(
        "false shadow at most {} of the lit pixels, false lit at most {} of the blocked ones{}",
        percent(limits.max_shadow_amount_rate), percent(limits.max_light_amount_rate),
        counts_asked(limits));
    const std::string views = result.views.size() == 1
                                  ? "in this view"
                                  : fmt::format("in each of {} views", result.views.size());
    if (result.methods) {
        return fmt::format(
            "{} ({}); its tables, in place of the job's own:\n",
            result.meets_limits()
                ? fmt::format("The least wrong of these settings meets the limits {}", views)
                : fmt::format("No setting meets the limits {}; the least wrong of "
                              "them",
                              views),
            asked);
    }
    if (result.meets_limits()) {
        return fmt::format("The cheapest of these settings that meets the limits {} ({}); its "
                           "keys, in place of the job's own:\n",
                           views, asked);
    }
    return fmt::format("No setting up to {0}x{0} meets the limits {1} ({2}); the one that is least "
                       "wrong; its keys, in place of the job's own:\n",
                       limits.max_resolution_texels, views, asked);
}

/// "Other culling and filters were not tried with 256 d16, 256 d24: …"
std::string not_tried(const TuneResult& result)
{
    return result.hopeless.empty()
               ? ""
               : fmt::format("Other culling and filters were not tried with {}, whose errors are "
                             "more than eight times the limits.\n",
                             fmt::join(hopeless_maps(result), ", "));
}

/// What GL measured with it, in each view.
std::string measured(const TuneResult& result, const TuneLimits& limits)
{
    std::string text = fmt::format("\n{:<14}{:>14}{:>12}{:>14}{:>12}  {}\n", "measured in",
                                   "false shadow", "false lit", "by count", "by count", "limits");
    for (std::size_t i = 0; i < result.measured_views.size(); ++i) {
        const ViewOutcome& view = result.measured_views[i];
        text +=
            fmt::format("{:<14}{:>14}{:>12}{:>14}{:>12}  {}\n", result.views[i].name,
                        percent(view.shadow_rate()), percent(view.light_rate()),
                        percent(view.metrics.false_shadow_rate),
                        percent(view.metrics.false_lit_rate), meets(view, limits) ? "met" : "-");
    }
    if (result.measured_views.size() > 1) {
        const std::size_t worst = analysis::worst_view(result.measured_views);
        text += fmt::format("All together {}; the worst is {} with {}.\n",
                            percent(analysis::pooled(result.measured_views).error_rate()),
                            result.views[worst].name,
                            percent(result.measured_views[worst].error_rate()));
    }
    if (result.passed_over > 0) {
        text += fmt::format("{} passed over: they show too little, or make no view.\n",
                            counted(result.passed_over, "view"));
    }
    return text;
}

std::string states(const TuneResult& result)
{
    std::string text;
    if (!has_key(result.best(), "shadow_map.")) {
        return text;
    }
    for (const ApiState& state : api_states(result.best(), map_offset(result))) {
        text += fmt::format("\n{}:\n  {}\n", state.api, fmt::join(state.lines, "\n  "));
    }
    return text;
}

/// What is considered of each map and filter.
std::string maps_text(const TuneResult& result, TuneDetail detail)
{
    return fmt::format(
               "{} considered; of each map and filter the best bias, slope and normal offset "
               "[texels], and its errors by amount, without what the filter softens on purpose:"
               "\n\n",
               counted(result.considered.size(), "setting")) +
           table(result, detail) + not_tried(result);
}

std::string light_text(const TunedLight& tuned, const TuneLimits& limits, TuneDetail detail)
{
    if (detail == TuneDetail::answer) {
        return best_toml(tuned);
    }
    const TuneResult& result = tuned.result;
    std::string text = result.methods ? methods_text(result, detail == TuneDetail::tried)
                                      : maps_text(result, detail);
    text += fmt::format("\n{}\n{}", verdict(result, limits), best_toml(tuned));
    text += states(result);
    text += measured(result, limits) + "\n";
    for (const std::string& sentence : errors_in_words(result.measured)) {
        text += sentence + "\n";
    }
    return text;
}

} // namespace

std::string tune_text(std::span<const TunedLight> lights, const TuneLimits& limits,
                      TuneDetail detail)
{
    std::string text;
    for (const TunedLight& tuned : lights) {
        const bool is_headed = !tuned.light.empty() && detail != TuneDetail::answer;
        text += text.empty() ? "" : "\n";
        text += is_headed ? heading_line("light " + tuned.light) : std::string{};
        text += light_text(tuned, limits, detail);
    }
    return text;
}

} // namespace gnomon::reports
