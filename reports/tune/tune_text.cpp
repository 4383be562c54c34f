#include "reports/tune/tune_report.hpp"

#include "reports/tables/table_lines.hpp"
#include "reports/text/description.hpp"
#include "reports/text/findings.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using analysis::TunedMethod;
using analysis::TunedSetting;
using analysis::TuneLimits;
using analysis::TuneResult;
using analysis::ViewOutcome;

std::string ranking_line(const TunedSetting& setting)
{
    const ViewOutcome pooled = setting.pooled();
    const bool has_bias = has_key(setting, "bias.");
    return fmt::format("{:<15}{:<11}{:<12}{:>10}{:>7}{:>12}{:>14}{:>12}{:>12}  {}\n",
                       setting.method->name, map_name(setting), filter_text(setting),
                       mebibytes(setting.cost.map_bytes), setting.cost.taps,
                       has_bias ? fmt::format("{:.4g}", setting.bias.constant()) : "-",
                       percent(pooled.shadow_rate()), percent(pooled.light_rate()),
                       percent(pooled.error_rate()), setting.meets_limits() ? "met" : "-");
}

/// "kernel_width = 9": the non-default keys.
std::string set_keys(const TunedSetting& setting)
{
    std::vector<std::string> keys;
    for (const auto& [key, value] : method_keys(setting)) {
        if (value != setting.keys->find(key)->default_value) {
            keys.push_back(fmt::format("{} = {}", key, scene::to_toml(value)));
        }
    }
    if (setting.slope != 0) {
        keys.push_back(fmt::format("bias.slope = {:.4g}", setting.slope));
    }
    if (setting.normal_texels != 0) {
        keys.push_back(fmt::format("bias.normal_texels = {:.3g}", setting.normal_texels));
    }
    return keys.empty() ? "no other key" : fmt::format("{}", fmt::join(keys, ", "));
}

std::string tried_lines(const TuneResult& result)
{
    std::string text = "\n";
    for (const TunedSetting& setting : result.considered) {
        text += fmt::format("{}{}\n", tuned_setting_line(setting),
                            setting.meets_limits() ? ", meets the limits" : "");
    }
    for (const TunedMethod& method : result.methods->ranked) {
        for (const analysis::RefusedSetting& refused : method.refused) {
            text += fmt::format("{}, {}: {}\n", method.name, fmt::join(refused.keys, ", "),
                                refused.reason);
        }
    }
    return text;
}

/// The ranking of a search over methods: the best setting of each method, its keys, and the methods
/// that were passed over.
/// @param lists_all  Adds every tried and every refused setting.
std::string methods_text(const TuneResult& result, bool lists_all)
{
    const analysis::MethodRanking& ranking = *result.methods;
    std::string text = fmt::format(
        "{} of {} considered, with maps of at most {}; of each method the least wrong, and its "
        "errors by amount, without what is softened on purpose:\n\n"
        "{:<15}{:<11}{:<12}{:>10}{:>7}{:>12}{:>14}{:>12}{:>12}  {}\n",
        counted(result.considered.size(), "setting"), counted(ranking.ranked.size(), "method"),
        mebibytes(ranking.max_bytes), "method", "map", "filter", "memory", "taps", "constant",
        "false shadow", "false lit", "error", "limits");
    for (const TunedMethod& method : ranking.ranked) {
        text += ranking_line(method.best);
    }
    text += "\n";
    for (const TunedMethod& method : ranking.ranked) {
        text += fmt::format("{}: {}\n", method.name, set_keys(method.best));
    }
    for (const analysis::PassedOverMethod& method : ranking.passed_over) {
        text += fmt::format("{} was passed over: {}\n", method.method, method.reason);
    }
    return text + (lists_all ? tried_lines(result) : "");
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

/// @param width  columns for `shape_text`.
std::string table_line(const TunedSetting& setting, int width)
{
    const ViewOutcome pooled = setting.pooled();
    return fmt::format("{:<11}{:<{}}{:<13}{:<7}{:<10}{:>10}{:>12.4g}{:>11.4g}{:>8.3g}{:>14}{:>12}  "
                       "{}\n",
                       map_name(setting), shape_text(setting), width, range(setting.map.frustum),
                       scene::cull_name(setting.map.cull), filter_text(setting),
                       mebibytes(setting.cost.map_bytes), setting.bias.constant(), setting.slope,
                       setting.normal_texels, percent(pooled.shadow_rate()),
                       percent(pooled.light_rate()), setting.meets_limits() ? "met" : "-");
}

std::string table(const TuneResult& result)
{
    const int width = std::ranges::any_of(result.considered, has_cascades) ? 26 : 10;
    std::string text =
        fmt::format("{:<11}{:<{}}{:<13}{:<7}{:<10}{:>10}{:>12}{:>11}{:>8}{:>14}{:>12}  {}\n", "map",
                    "fit", width, "near, far", "cull", "filter", "memory", "constant", "slope",
                    "offset", "false shadow", "false lit", "limits");
    for (const TunedSetting& setting : result.considered) {
        text += table_line(setting, width);
    }
    return text;
}

/// "; by count false lit at most 1 %"; limits of 1 are left out.
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

/// "false shadow at most 0.1 % of the lit pixels, false lit at most 0.5 % of the blocked ones".
std::string limits_text(const TuneLimits& limits)
{
    return fmt::format(
        "false shadow at most {} of the lit pixels, false lit at most {} of the blocked ones{}",
        percent(limits.max_shadow_amount_rate), percent(limits.max_light_amount_rate),
        counts_asked(limits));
}

std::string views_text(const TuneResult& result)
{
    return result.views.size() == 1 ? "in this view"
                                    : fmt::format("in each of {} views", result.views.size());
}

std::string method_verdict(const TuneResult& result)
{
    return fmt::format("{} ({}); its tables, in place of the job's own:\n",
                       result.meets_limits()
                           ? fmt::format("The least wrong of these settings meets the limits {}",
                                         views_text(result))
                           : fmt::format("No setting meets the limits {}; the least wrong of them",
                                         views_text(result)),
                       limits_text(result.limits));
}

/// "1024 d16, fit camera, nearest".
std::string short_text(const TunedSetting& setting)
{
    const std::string filter =
        setting.has_filter ? fmt::format(", {}", filter_text(setting)) : std::string{};
    return fmt::format("{}, {} {}{}", map_name(setting), has_cascades(setting) ? "cascades" : "fit",
                       shape_text(setting), filter);
}

/// ", with 12.5 % of its memory"; empty if it needs as much.
std::string memory_text(const TunedSetting& best, const TunedSetting& least_wrong)
{
    const double share =
        static_cast<double>(best.cost.map_bytes) / static_cast<double>(least_wrong.cost.map_bytes);
    return share < 1 ? fmt::format(", with {} of its memory", percent(share)) : std::string{};
}

/// The result in one sentence.
std::string verdict(const TuneResult& result)
{
    const TunedSetting& best = result.best();
    const std::string tried = counted(result.considered.size(), "setting");
    if (!result.recommends()) {
        return fmt::format(
            "No setting up to {0}x{0} serves {1}: the least wrong of {2} tried, {3} ({4}), "
            "still lights {5} of what is blocked. Nothing is recommended.\n",
            result.limits.max_resolution_texels, views_text(result), tried, short_text(best),
            mebibytes(best.cost.map_bytes), percent(result.most_lit()));
    }
    if (!result.meets_limits()) {
        return fmt::format("No setting up to {0}x{0} meets the limits {1} ({2}); of {3} tried {4} "
                           "({5}) is the least wrong:\n",
                           result.limits.max_resolution_texels, views_text(result),
                           limits_text(result.limits), tried, short_text(best),
                           mebibytes(best.cost.map_bytes));
    }
    if (result.relative_limits < 2) {
        return fmt::format("{} ({}) is the cheapest of {} tried that meets the limits {} ({}):\n",
                           short_text(best), mebibytes(best.cost.map_bytes), tried,
                           views_text(result), limits_text(result.limits));
    }
    if (result.recommended == result.least_wrong) {
        return fmt::format("{} ({}) is the least wrong of {} tried {}, and none of them that is as "
                           "good is cheaper:\n",
                           short_text(best), mebibytes(best.cost.map_bytes), tried,
                           views_text(result));
    }
    const TunedSetting& least_wrong = result.considered[result.least_wrong];
    const std::string other = short_text(least_wrong) == short_text(best)
                                  ? std::string{"it is with other biases"}
                                  : short_text(least_wrong);
    return fmt::format("{} ({}) is as good {} as {}, the least wrong of {} tried{}:\n",
                       short_text(best), mebibytes(best.cost.map_bytes), views_text(result), other,
                       tried, memory_text(best, least_wrong));
}

/// GL's errors with the recommended setting, and the limits; in the worst of several views.
std::string measured_sentence(const TuneResult& result)
{
    const std::size_t worst = analysis::worst_view(result.measured_views);
    const ViewOutcome& view = result.measured_views[worst];
    const bool is_softened = view.shadow_softening + view.light_softening > 0;
    return fmt::format("GL measures {} of false shadow and {} of false lit by amount{}{}; the "
                       "limits are {} and {}{}.\n",
                       percent(view.shadow_rate()), percent(view.light_rate()),
                       is_softened ? " without softened borders" : "",
                       result.views.size() == 1
                           ? std::string{}
                           : fmt::format(" in the worst view ({})", result.views[worst].name),
                       percent(result.limits.max_shadow_amount_rate),
                       percent(result.limits.max_light_amount_rate), counts_asked(result.limits));
}

/// That the time ran out, and how to go on; empty if all settings were tried.
std::string time_sentence(const TuneResult& result)
{
    constexpr double longer = 4;
    return result.is_cut_short
               ? fmt::format(
                     "Not all was tried in the {:g} s that were given; `--time {:g}` tries more.\n",
                     result.time_s, longer * result.time_s)
               : std::string{};
}

/// GL's errors with the recommended setting, by view.
std::string measured(const TuneResult& result)
{
    std::string text = fmt::format("\n{:<14}{:>14}{:>12}{:>14}{:>12}  {}\n", "measured in",
                                   "false shadow", "false lit", "by count", "by count", "limits");
    for (std::size_t i = 0; i < result.measured_views.size(); ++i) {
        const ViewOutcome& view = result.measured_views[i];
        text += fmt::format("{:<14}{:>14}{:>12}{:>14}{:>12}  {}\n", result.views[i].name,
                            percent(view.shadow_rate()), percent(view.light_rate()),
                            percent(view.metrics.false_shadow_rate),
                            percent(view.metrics.false_lit_rate),
                            meets(view, result.limits) ? "met" : "-");
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
    for (const ApiState& state :
         api_states(result.best(), map_offset(result), other_biases(result.measured.job))) {
        text += fmt::format("\n{}:\n  {}\n", state.api, fmt::join(state.lines, "\n  "));
    }
    return text;
}

/// The settings that were tried for each map and filter.
std::string maps_text(const TuneResult& result)
{
    return fmt::format("{} tried, each with the constant bias that is recommended for it, and its "
                       "errors by "
                       "amount, without what the filter softens on purpose; offsets in texels:\n\n",
                       counted(result.considered.size(), "setting")) +
           table(result);
}

/// Sentences about the constant bias; empty if the method has none.
std::string constant_bias(const TuneResult& result)
{
    if (!has_key(result.best(), "bias.constant")) {
        return {};
    }
    const analysis::FoundBias& bias = result.best().bias;
    const std::string_view unit = length_unit(result.measured);
    const auto sentences =
        bias_sentences({bias.length, bias.low, bias.high, bias.recommended.margin, unit});
    return fmt::format("The constant bias is {:.3g} {}, {:.3g} texels. {}\n", bias.length.metres,
                       unit, bias.length.texels, fmt::join(sentences, " "));
}

/// The answer in ten lines: the keys to change, and the resulting errors.
std::string brief_text(const TunedLight& tuned)
{
    const TuneResult& result = tuned.result;
    if (!result.recommends()) {
        return verdict(result) + time_sentence(result) +
               "--verbose lists all settings, and why the least wrong one is wrong.\n";
    }
    const std::string changed = changed_toml(tuned);
    return verdict(result) + (changed.empty() ? "The job has these settings.\n" : changed) +
           constant_bias(result) + measured_sentence(result) + time_sentence(result) +
           "--verbose lists all settings, states for GL, Direct3D and Vulkan, and why the rest is "
           "wrong.\n";
}

/// The setting's errors and their causes.
std::string errors_text(const TuneResult& result)
{
    std::string text = measured(result) + "\n";
    for (const std::string& sentence : errors_as_text(result.measured)) {
        text += sentence + "\n";
    }
    return text;
}

/// The recommended setting's bias, API states and errors.
std::string details_text(const TuneResult& result)
{
    const std::string bias = constant_bias(result);
    return (bias.empty() ? "" : "\n" + bias) + states(result) + errors_text(result);
}

std::string light_text(const TunedLight& tuned, TuneDetail detail)
{
    const TuneResult& result = tuned.result;
    if (!result.nothing.empty()) {
        return result.nothing + "\n";
    }
    if (detail == TuneDetail::answer) {
        return result.recommends() ? best_toml(tuned) : verdict(result);
    }
    if (result.methods) {
        const std::string tried = methods_text(result, detail == TuneDetail::tried) + "\n";
        return tried + (result.recommends()
                            ? method_verdict(result) + best_toml(tuned) + details_text(result)
                            : verdict(result));
    }
    if (detail == TuneDetail::found) {
        return brief_text(tuned);
    }
    if (!result.recommends()) {
        return fmt::format("{}\n{}{}", maps_text(result), verdict(result), time_sentence(result)) +
               errors_text(result);
    }
    return fmt::format("{}\n{}{}{}", maps_text(result), verdict(result), best_toml(tuned),
                       time_sentence(result)) +
           details_text(result);
}

} // namespace

std::string tune_text(std::span<const TunedLight> lights, TuneDetail detail)
{
    std::string text;
    for (const TunedLight& tuned : lights) {
        const bool is_headed = !tuned.light.empty() && detail != TuneDetail::answer;
        text += text.empty() ? "" : "\n";
        text += is_headed ? heading_line("light " + tuned.light) : std::string{};
        text += light_text(tuned, detail);
    }
    return text;
}

} // namespace gnomon::reports
