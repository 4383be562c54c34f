#include "reports/tables/tune_report.hpp"

#include "analysis/advice/fit_setting.hpp"
#include "methods/list.hpp"
#include "reports/json/advice_json.hpp"
#include "reports/tables/graphics_api_states.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/words/findings.hpp"
#include "reports/words/remedy_words.hpp"
#include "reports/words/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

namespace gnomon::reports {

namespace {

using analysis::TunedSetting;
using analysis::TuneLimits;
using analysis::TuneResult;
using analysis::ViewOutcome;

std::string plane_text(const std::optional<double>& plane_m)
{
    return plane_m ? fmt::format("{}", *plane_m) : "\"auto\"";
}

store::Json plane_json(const std::optional<double>& plane_m)
{
    return plane_m ? store::Json(*plane_m) : store::Json("auto");
}

bool has_cascades(const TunedSetting& setting)
{
    return setting.map.layout == scene::MapLayout::cascades;
}

/// "scene"; of cascades "4 tight, 0.5", their number, fit and λ, or their split.
std::string shape_text(const TunedSetting& setting)
{
    if (!has_cascades(setting)) {
        return std::string{scene::fit_name(setting.map.frustum.fit)};
    }
    const scene::CascadeSettings& cascades = setting.map.cascades;
    return fmt::format("{} {}, {}", cascades.count, scene::cascade_fit_name(cascades.fit),
                       cascades.split == scene::CascadeSplit::practical
                           ? fmt::format("{}", cascades.split_lambda)
                           : std::string{scene::cascade_split_name(cascades.split)});
}

/// Its lines in a job file: `fit`, or those of cascades.
std::string shape_toml(const TunedSetting& setting, scene::Fit own_fit)
{
    if (!has_cascades(setting)) {
        return analysis::fit_setting(own_fit, setting.map.frustum.fit);
    }
    const scene::CascadeSettings& cascades = setting.map.cascades;
    const std::string lambda = cascades.split == scene::CascadeSplit::practical
                                   ? fmt::format("split_lambda = {}\n", cascades.split_lambda)
                                   : std::string{};
    return fmt::format(
        "layout = \"cascades\"\ncascades = {}\nsplit = \"{}\"\n{}cascade_fit = \"{}\"",
        cascades.count, scene::cascade_split_name(cascades.split), lambda,
        scene::cascade_fit_name(cascades.fit));
}

store::Json setting_json(const TunedSetting& setting)
{
    const analysis::BiasInterval& run = setting.bias.run;
    store::Json json{
        {"shadow_map.resolution", setting.map.resolution_texels},
        {"shadow_map.depth_format", scene::depth_format_name(setting.map.depth_format)},
        {"shadow_map.fit", scene::fit_name(setting.map.frustum.fit)},
        {"shadow_map.near", plane_json(setting.map.frustum.near_m)},
        {"shadow_map.far", plane_json(setting.map.frustum.far_m)},
        {"shadow_map.cull", scene::cull_name(setting.map.cull)},
        {"lookup.filter", setting.has_filter ? store::Json(scene::filter_name(setting.filter))
                                             : store::Json(nullptr)},
        {"bias.constant", setting.bias.constant()},
        {"bias.slope", setting.slope},
        {"bias.normal_texels", setting.normal_texels},
        {"map_bytes", setting.cost.map_bytes},
        {"taps", setting.cost.taps}};
    if (setting.bias.pasted.constant_m) {
        json["bias.constant_m"] = *setting.bias.pasted.constant_m;
    }
    if (has_cascades(setting)) {
        const scene::CascadeSettings& cascades = setting.map.cascades;
        json["shadow_map.cascades"] = cascades.count;
        json["shadow_map.split"] = scene::cascade_split_name(cascades.split);
        json["shadow_map.cascade_fit"] = scene::cascade_fit_name(cascades.fit);
        if (cascades.split == scene::CascadeSplit::practical) {
            json["shadow_map.split_lambda"] = cascades.split_lambda;
        }
    }
    json.update(outcome_json(setting.pooled()));
    json["best_interval"] = {run.lo,
                             std::isfinite(run.hi) ? store::Json(run.hi) : store::Json(nullptr)};
    json["views"] = setting.bias.outcomes.size();
    json["meets_limits"] = setting.meets_limits();
    return json;
}

/// "–" where the method has no filter.
std::string_view filter_text(const TunedSetting& setting)
{
    return setting.has_filter ? scene::filter_name(setting.filter) : "–";
}

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

std::string map_name(const TunedSetting& setting)
{
    return fmt::format("{} {}", setting.map.resolution_texels,
                       scene::depth_format_name(setting.map.depth_format));
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
    if (result.meets_limits()) {
        return fmt::format("The cheapest of these settings that meets the limits {} ({}); its "
                           "keys, in place of the job's own:\n",
                           views, asked);
    }
    return fmt::format("No setting up to {0}x{0} meets the limits {1} ({2}); the one that is least "
                       "wrong; its keys, in place of the job's own:\n",
                       limits.max_resolution_texels, views, asked);
}

std::vector<std::string> hopeless_maps(const TuneResult& result)
{
    std::vector<std::string> names;
    for (const analysis::MapSize& size : result.hopeless) {
        const std::string maps =
            size.cascades > 0 ? fmt::format("{} × ", size.cascades) : std::string{};
        names.push_back(fmt::format("{}{} {}", maps, size.resolution_texels,
                                    scene::depth_format_name(size.format)));
    }
    return names;
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

/// What the job draws its maps with, of whatever setting.
std::optional<methods::PolygonOffset> map_offset(const TuneResult& result)
{
    return methods::map_offset(result.measured.job, result.measured.view);
}

std::string states(const TuneResult& result)
{
    std::string text;
    for (const ApiState& state : api_states(result.best(), map_offset(result))) {
        text += fmt::format("\n{}:\n  {}\n", state.api, fmt::join(state.lines, "\n  "));
    }
    return text;
}

store::Json views_json(const TuneResult& result, const TuneLimits& limits)
{
    store::Json json = store::Json::array();
    for (std::size_t i = 0; i < result.views.size(); ++i) {
        const scene::Job& job = result.views[i].job;
        store::Json view = view_json(result.views[i].name, *job.camera, *job.light);
        view["measured"] = outcome_json(result.measured_views[i]);
        view["meets_limits"] = meets(result.measured_views[i], limits);
        json.push_back(std::move(view));
    }
    return json;
}

store::Json states_json(const TuneResult& result)
{
    store::Json json = store::Json::object();
    for (const ApiState& state : api_states(result.best(), map_offset(result))) {
        json[state.api] = state.lines;
    }
    return json;
}

} // namespace

std::string tune_toml(const TunedSetting& setting, scene::Fit own_fit, const std::string& light)
{
    const std::string_view table = light.empty() ? "" : "lights.";
    const std::string heading = light.empty() ? "" : fmt::format("# [[lights]] {}\n", light);
    return fmt::format("{}[{}shadow_map]\n"
                       "resolution = {}\n"
                       "depth_format = \"{}\"\n"
                       "{}\n"
                       "near = {}\n"
                       "far = {}\n"
                       "cull = \"{}\"\n"
                       "{}"
                       "[{}bias]\n"
                       "{}\n"
                       "slope = {}\n"
                       "normal_texels = {}\n",
                       heading, table, setting.map.resolution_texels,
                       scene::depth_format_name(setting.map.depth_format),
                       shape_toml(setting, own_fit), plane_text(setting.map.frustum.near_m),
                       plane_text(setting.map.frustum.far_m), scene::cull_name(setting.map.cull),
                       setting.has_filter ? fmt::format("[{}lookup]\nfilter = \"{}\"\n", table,
                                                        scene::filter_name(setting.filter))
                                          : std::string{},
                       table, setting.bias.pasted.key.substr(std::size("bias.") - 1), setting.slope,
                       setting.normal_texels);
}

std::string tuned_setting_line(const TunedSetting& setting)
{
    const ViewOutcome pooled = setting.pooled();
    return fmt::format("{}, {} {}, cull {}, {}, slope {:.4g}, offset {:.3g}: false shadow {}, "
                       "false lit {}{}",
                       map_name(setting), has_cascades(setting) ? "cascades" : "fit",
                       shape_text(setting), scene::cull_name(setting.map.cull),
                       filter_text(setting), setting.slope, setting.normal_texels,
                       percent(pooled.shadow_rate()), percent(pooled.light_rate()),
                       setting.meets_limits() ? ", meets the limits" : "");
}

namespace {

/// The keys that are recommended.
std::string best_toml(const TunedLight& tuned)
{
    const TuneResult& result = tuned.result;
    return tune_toml(result.best(), result.views.front().job.shadow_map.frustum.fit, tuned.light);
}

std::string light_text(const TunedLight& tuned, const TuneLimits& limits, TuneDetail detail)
{
    if (detail == TuneDetail::answer) {
        return best_toml(tuned);
    }
    const TuneResult& result = tuned.result;
    std::string text = fmt::format(
        "{} considered; of each map and filter the best bias, slope and normal offset [texels], "
        "and its errors by amount, without what the filter softens on purpose:\n\n",
        counted(result.considered.size(), "setting"));
    text += table(result, detail) + not_tried(result) + "\n";
    text += verdict(result, limits) + "\n" + best_toml(tuned);
    text += states(result);
    text += measured(result, limits) + "\n";
    for (const std::string& sentence : errors_in_words(result.measured)) {
        text += sentence + "\n";
    }
    return text;
}

store::Json light_json(const TunedLight& tuned, const TuneLimits& limits)
{
    const TuneResult& result = tuned.result;
    const analysis::Metrics& measured = result.measured.metrics;
    store::Json json{{"meets_limits", result.meets_limits()},
                     {"limits",
                      {{"max_shadow_amount_rate", limits.max_shadow_amount_rate},
                       {"max_light_amount_rate", limits.max_light_amount_rate},
                       {"max_false_shadow_rate", limits.max_false_shadow_rate},
                       {"max_false_lit_rate", limits.max_false_lit_rate},
                       {"max_resolution", limits.max_resolution_texels}}},
                     {"recommended", setting_json(result.best())},
                     {"toml", best_toml(tuned)},
                     {"states", states_json(result)},
                     {"measured",
                      {{"false_shadow", measured.false_shadow},
                       {"false_lit", measured.false_lit},
                       {"false_shadow_rate", store::number_or_null(measured.false_shadow_rate)},
                       {"false_lit_rate", store::number_or_null(measured.false_lit_rate)},
                       {"error_rate", store::number_or_null(measured.error_rate)},
                       {"shadow_amount", measured.amounts.shadow},
                       {"light_amount", measured.amounts.light}}},
                     {"views", views_json(result, limits)},
                     {"views_passed_over", result.passed_over},
                     {"pooled", outcome_json(analysis::pooled(result.measured_views))},
                     {"worst_view", result.views[analysis::worst_view(result.measured_views)].name},
                     {"why", errors_in_words(result.measured)},
                     {"hopeless_maps", hopeless_maps(result)}};
    json["considered"] = store::Json::array();
    for (const TunedSetting& setting : result.considered) {
        json["considered"].push_back(setting_json(setting));
    }
    return json;
}

bool all_meet(std::span<const TunedLight> lights)
{
    return std::ranges::all_of(lights,
                               [](const TunedLight& tuned) { return tuned.result.meets_limits(); });
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

std::string tune_json(std::span<const TunedLight> lights, const TuneLimits& limits)
{
    store::Json json{{"schema", 1}};
    if (lights.front().light.empty()) {
        json.update(light_json(lights.front(), limits));
        return json.dump(2) + "\n";
    }
    json["meets_limits"] = all_meet(lights);
    json["lights"] = store::Json::array();
    for (const TunedLight& tuned : lights) {
        store::Json of_light{{"name", tuned.light}};
        of_light.update(light_json(tuned, limits));
        json["lights"].push_back(std::move(of_light));
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
