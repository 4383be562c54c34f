#include "reports/tables/method_ranking_table.hpp"

#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"
#include "reports/text/tuned_setting.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using analysis::TunedMethod;
using analysis::TunedSetting;
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

/// "kernel_width = 9": the keys that are not at their defaults.
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

} // namespace

std::string methods_text(const TuneResult& result, bool tells_all)
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
    return text + (tells_all ? tried_lines(result) : "");
}

} // namespace gnomon::reports
