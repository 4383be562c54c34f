#include "reports/tables/tune_report.hpp"

#include "reports/tables/graphics_api_states.hpp"
#include "reports/tables/method_ranking_table.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/text/description.hpp"
#include "reports/text/findings.hpp"
#include "reports/text/recommendation_text.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace gnomon::reports {

namespace {

using analysis::TunedSetting;
using analysis::TuneLimits;
using analysis::TuneResult;
using analysis::ViewOutcome;

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

/// ", an eighth of its memory", or less; empty: as much.
std::string memory_text(const TunedSetting& best, const TunedSetting& least_wrong)
{
    const double share =
        static_cast<double>(best.cost.map_bytes) / static_cast<double>(least_wrong.cost.map_bytes);
    return share < 1 ? fmt::format(", with {} of its memory", percent(share)) : std::string{};
}

/// What was found, in a sentence.
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

/// What GL measures with it, beside the limits; of several views the worst.
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

/// That the time was up, and how to go on; empty: all was tried.
std::string time_sentence(const TuneResult& result)
{
    constexpr double longer = 4;
    return result.is_cut_short
               ? fmt::format(
                     "Not all was tried in the {:g} s that were given; `--time {:g}` tries more.\n",
                     result.time_s, longer * result.time_s)
               : std::string{};
}

/// What GL measured with it, in each view.
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
         api_states(result.best(), map_offset(result), other_biases(result))) {
        text += fmt::format("\n{}:\n  {}\n", state.api, fmt::join(state.lines, "\n  "));
    }
    return text;
}

/// What is considered of each map and filter.
std::string maps_text(const TuneResult& result)
{
    return fmt::format("{} tried, each with the constant bias that is recommended for it, and its "
                       "errors by "
                       "amount, without what the filter softens on purpose; offsets in texels:\n\n",
                       counted(result.considered.size(), "setting")) +
           table(result);
}

/// What is said of the constant bias; empty where the setting's method has none.
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

/// The answer in ten lines: what to set, and what it gives.
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

/// Measurements and causes of the setting.
std::string errors_text(const TuneResult& result)
{
    std::string text = measured(result) + "\n";
    for (const std::string& sentence : errors_as_text(result.measured)) {
        text += sentence + "\n";
    }
    return text;
}

/// How what is recommended is set, and its errors.
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
