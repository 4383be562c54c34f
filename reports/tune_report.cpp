#include "reports/tune_report.hpp"

#include "reports/findings.hpp"
#include "reports/json_values.hpp"
#include "reports/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <tuple>

namespace gnomon::reports {

namespace {

using analysis::TunedSetting;
using analysis::TuneLimits;
using analysis::TuneResult;

std::string plane_text(const std::optional<double>& plane_m)
{
    return plane_m ? fmt::format("{}", *plane_m) : "\"auto\"";
}

Json plane_json(const std::optional<double>& plane_m)
{
    return plane_m ? Json(*plane_m) : Json("auto");
}

Json setting_json(const TunedSetting& setting)
{
    return {{"shadow_map.resolution", setting.map.resolution_texels},
            {"shadow_map.depth_format", scene::depth_format_name(setting.map.depth_format)},
            {"shadow_map.near", plane_json(setting.map.frustum.near_m)},
            {"shadow_map.far", plane_json(setting.map.frustum.far_m)},
            {"bias.constant", setting.constant},
            {"bias.slope", setting.slope},
            {"bias.normal_texels", setting.normal_texels},
            {"map_bytes", analysis::map_bytes(setting.map)},
            {"false_shadow", setting.errors.false_shadow},
            {"false_lit", setting.errors.false_lit},
            {"false_shadow_rate", number_or_null(setting.false_shadow_rate)},
            {"false_lit_rate", number_or_null(setting.false_lit_rate)},
            {"error_rate", number_or_null(setting.error_rate)},
            {"shadow_amount", setting.amounts.shadow},
            {"light_amount", setting.amounts.light},
            {"shadow_softening", setting.shadow_softening},
            {"light_softening", setting.light_softening},
            {"best_interval", {setting.interval.lo, setting.interval.hi}},
            {"meets_limits", setting.meets_limits}};
}

/// Maps that differ only in slope, offset and bias share a line: the best of them.
std::vector<const TunedSetting*> best_of_each_map(const TuneResult& result)
{
    using Key = std::tuple<int, std::string, std::optional<double>, std::optional<double>>;
    std::map<Key, std::size_t> lines;
    std::vector<const TunedSetting*> best;
    for (const TunedSetting& setting : result.considered) {
        const Key key{setting.map.resolution_texels,
                      scene::depth_format_name(setting.map.depth_format),
                      setting.map.frustum.near_m, setting.map.frustum.far_m};
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

std::string mebibytes(std::uint64_t bytes)
{
    return fmt::format("{:.3g} MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
}

std::string table(const TuneResult& result)
{
    std::string text = fmt::format("{:<14}{:<14}{:>10}{:>12}{:>12}{:>9}{:>14}{:>12}{:>12}  {}\n",
                                   "map", "near, far", "memory", "constant", "slope", "offset",
                                   "false shadow", "false lit", "errors", "limits");
    for (const TunedSetting* setting : best_of_each_map(result)) {
        text += fmt::format("{:<14}{:<14}{:>10}{:>12.4g}{:>12.4g}{:>9.3g}{:>14}{:>12}{:>12}  {}\n",
                            fmt::format("{} {}", setting->map.resolution_texels,
                                        scene::depth_format_name(setting->map.depth_format)),
                            range(setting->map.frustum),
                            mebibytes(analysis::map_bytes(setting->map)), setting->constant,
                            setting->slope, setting->normal_texels, percent(setting->shadow_rate),
                            percent(setting->light_rate), grouped_amount(setting->error_amount()),
                            setting->meets_limits ? "met" : "-");
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
    if (result.meets_limits) {
        return fmt::format(
            "The smallest of these maps that meets the limits ({}); its keys, in place "
            "of the job's own:\n",
            asked);
    }
    return fmt::format("No setting up to {0}x{0} meets the limits ({1}); the one that is least "
                       "wrong; its keys, in place of the job's own:\n",
                       limits.max_resolution_texels, asked);
}

/// What verdicts that are fractions add; empty where none are.
std::string measured_amounts(const TuneResult& result)
{
    const analysis::Metrics& measured = result.measured.metrics;
    if (!has_fractions(measured)) {
        return "";
    }
    const TunedSetting& best = result.best();
    return fmt::format(
        "By amount: {} px of false shadow ({} of them softened borders), {} px of "
        "false light ({}).\n",
        grouped_amount(measured.amounts.shadow), grouped_amount(best.shadow_softening),
        grouped_amount(measured.amounts.light), grouped_amount(best.light_softening));
}

} // namespace

std::string tune_toml(const TunedSetting& setting)
{
    return fmt::format(
        "[shadow_map]\n"
        "resolution = {}\n"
        "depth_format = \"{}\"\n"
        "near = {}\n"
        "far = {}\n"
        "[bias]\n"
        "constant = {}\n"
        "slope = {}\n"
        "normal_texels = {}\n",
        setting.map.resolution_texels, scene::depth_format_name(setting.map.depth_format),
        plane_text(setting.map.frustum.near_m), plane_text(setting.map.frustum.far_m),
        setting.constant, setting.slope, setting.normal_texels);
}

std::string tune_text(const TuneResult& result, const TuneLimits& limits)
{
    const analysis::Metrics& measured = result.measured.metrics;
    std::string text = fmt::format(
        "{} settings considered; of each map the best bias, slope and normal offset [texels], "
        "and its errors by amount [px], without what the filter softens on purpose:\n\n",
        grouped(result.considered.size()));
    text += table(result);
    text += "\n";
    text += verdict(result, limits);
    text += "\n";
    text += tune_toml(result.best());
    text += fmt::format("\nMeasured with it: {} false shadow ({}), {} false lit ({}).\n",
                        grouped(measured.false_shadow), percent(measured.false_shadow_rate),
                        grouped(measured.false_lit), percent(measured.false_lit_rate));
    text += measured_amounts(result);
    for (const std::string& sentence : errors_in_words(result.measured)) {
        text += sentence + "\n";
    }
    return text;
}

std::string tune_json(const TuneResult& result, const TuneLimits& limits)
{
    const analysis::Metrics& measured = result.measured.metrics;
    Json json{{"schema", 1},
              {"meets_limits", result.meets_limits},
              {"limits",
               {{"max_shadow_amount_rate", limits.max_shadow_amount_rate},
                {"max_light_amount_rate", limits.max_light_amount_rate},
                {"max_false_shadow_rate", limits.max_false_shadow_rate},
                {"max_false_lit_rate", limits.max_false_lit_rate},
                {"max_resolution", limits.max_resolution_texels}}},
              {"recommended", setting_json(result.best())},
              {"toml", tune_toml(result.best())},
              {"measured",
               {{"false_shadow", measured.false_shadow},
                {"false_lit", measured.false_lit},
                {"false_shadow_rate", number_or_null(measured.false_shadow_rate)},
                {"false_lit_rate", number_or_null(measured.false_lit_rate)},
                {"error_rate", number_or_null(measured.error_rate)},
                {"shadow_amount", measured.amounts.shadow},
                {"light_amount", measured.amounts.light}}},
              {"why", errors_in_words(result.measured)}};
    json["considered"] = Json::array();
    for (const TunedSetting& setting : result.considered) {
        json["considered"].push_back(setting_json(setting));
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
