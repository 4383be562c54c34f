#include "reports/tune/tuned_setting.hpp"

#include "analysis/advice/map_fit.hpp"
#include "methods/job_method.hpp"
#include "reports/text/text.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <set>

namespace gnomon::reports {

using analysis::TunedSetting;
using analysis::TuneResult;
using analysis::ViewOutcome;

namespace {

std::string plane_text(const std::optional<double>& plane_m)
{
    return plane_m ? fmt::format("{}", *plane_m) : "\"auto\"";
}

/// "constant = 0.002" of "bias.constant = 0.002".
std::string bare_name(const std::string& key)
{
    return key.substr(key.find('.') + 1);
}

} // namespace

bool has_cascades(const TunedSetting& setting)
{
    return setting.map.layout == scene::MapLayout::cascades;
}

bool has_key(const TunedSetting& setting, std::string_view key)
{
    return !setting.method || setting.keys->has_key(setting.method->name, key);
}

std::vector<std::pair<std::string, scene::JobValue>> method_keys(const TunedSetting& setting)
{
    std::vector<std::pair<std::string, scene::JobValue>> keys;
    if (!setting.method) {
        return keys;
    }
    const scene::MethodSettings& method = *setting.method;
    for (const scene::Key& key : setting.keys->rows()) {
        const bool is_set = method.values.contains(key.name);
        if (key.is_added() && key.is_of(method.name) &&
            (is_set || key.name.starts_with("method."))) {
            keys.emplace_back(key.name, key.value_of(method));
        }
    }
    return keys;
}

std::string shape_text(const TunedSetting& setting)
{
    if (setting.sets_half_extent) {
        return fmt::format("half_extent {:g}", setting.map.frustum.half_extent_m);
    }
    if (!has_cascades(setting)) {
        return std::string{scene::fit_name(setting.map.frustum.fit)};
    }
    const scene::CascadeSettings& cascades = setting.map.cascades;
    return fmt::format("{} {}, {}", cascades.count, scene::cascade_fit_name(cascades.fit),
                       cascades.split == scene::CascadeSplit::practical
                           ? fmt::format("{}", cascades.split_lambda)
                           : std::string{scene::cascade_split_name(cascades.split)});
}

namespace {

/// The job-file lines of `fit` or of the cascades.
std::string shape_toml(const TunedSetting& setting, scene::Fit own_fit)
{
    if (setting.sets_half_extent) {
        return fmt::format("fit = \"fixed\"\nhalf_extent = {}", setting.map.frustum.half_extent_m);
    }
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

} // namespace

std::string_view filter_text(const TunedSetting& setting)
{
    return setting.has_filter ? scene::filter_name(setting.filter) : "–";
}

std::string map_name(const TunedSetting& setting)
{
    if (!has_key(setting, "shadow_map.")) {
        return "no map";
    }
    return fmt::format("{} {}", setting.map.resolution_texels,
                       scene::depth_format_name(setting.map.depth_format));
}

std::optional<methods::PolygonOffset> map_offset(const TuneResult& result)
{
    return methods::map_offset(result.measured.job, result.measured.view);
}

std::vector<std::string> other_biases(const scene::Job& job)
{
    std::vector<std::string> keys;
    for (const auto& [key, value] : job.method.values) {
        if (key.starts_with("bias.") && !key.starts_with("bias.polygon_offset")) {
            keys.push_back(fmt::format("{} = {}", key, scene::to_toml(value)));
        }
    }
    return keys;
}

namespace {

/// The lines of [method]; empty for the job's own method.
std::string method_toml(const TunedSetting& setting, std::string_view table)
{
    if (!setting.method) {
        return {};
    }
    std::string text = fmt::format("[{}method]\nname = \"{}\"\n", table, setting.method->name);
    for (const auto& [key, value] : method_keys(setting)) {
        if (key.starts_with("method.")) {
            text += fmt::format("{} = {}\n", bare_name(key), scene::to_toml(value));
        }
    }
    for (const std::string_view shared : {"shadow_map", "lookup", "bias"}) {
        if (!has_key(setting, fmt::format("{}.", shared))) {
            text += fmt::format("# and remove [{}{}]\n", table, shared);
        }
    }
    if (has_key(setting, "lookup.") && !setting.has_filter) {
        text += fmt::format("# and remove filter from [{}lookup]\n", table);
    }
    return text;
}

std::string map_toml(const TunedSetting& setting, std::string_view table, scene::Fit own_fit)
{
    return fmt::format("[{}shadow_map]\n"
                       "resolution = {}\n"
                       "depth_format = \"{}\"\n"
                       "{}\n"
                       "near = {}\n"
                       "far = {}\n"
                       "cull = \"{}\"\n",
                       table, setting.map.resolution_texels,
                       scene::depth_format_name(setting.map.depth_format),
                       shape_toml(setting, own_fit), plane_text(setting.map.frustum.near_m),
                       plane_text(setting.map.frustum.far_m), scene::cull_name(setting.map.cull));
}

std::string bias_toml(const TunedSetting& setting, std::string_view table)
{
    std::string text = fmt::format("[{}bias]\n"
                                   "{}\n"
                                   "slope = {}\n"
                                   "normal_texels = {}\n",
                                   table, bare_name(setting.bias.rounded.key), setting.slope,
                                   setting.normal_texels);
    for (const auto& [key, value] : method_keys(setting)) {
        if (key.starts_with("bias.")) {
            text += fmt::format("{} = {}\n", bare_name(key), scene::to_toml(value));
        }
    }
    return text;
}

} // namespace

std::string tune_toml(const TunedSetting& setting, scene::Fit own_fit, const std::string& light)
{
    const std::string_view table = light.empty() ? "" : "lights.";
    std::string text = light.empty() ? "" : fmt::format("# [[lights]] {}\n", light);
    text += method_toml(setting, table);
    if (has_key(setting, "shadow_map.")) {
        text += map_toml(setting, table, own_fit);
    }
    if (setting.has_filter) {
        text +=
            fmt::format("[{}lookup]\nfilter = \"{}\"\n", table, scene::filter_name(setting.filter));
    }
    if (has_key(setting, "bias.")) {
        text += bias_toml(setting, table);
    }
    return text;
}

namespace {

/// ", fit scene, cull none, pcf3, slope 0.1, offset 1"; empty without a map.
std::string tried_text(const TunedSetting& setting)
{
    if (!has_key(setting, "shadow_map.")) {
        return {};
    }
    return fmt::format(", {} {}, cull {}, {}, slope {:.4g}, offset {:.3g}",
                       has_cascades(setting) ? "cascades" : "fit", shape_text(setting),
                       scene::cull_name(setting.map.cull), filter_text(setting), setting.slope,
                       setting.normal_texels);
}

/// "evsm, kernel_width = 9, ": the method and its non-default keys.
std::string method_text(const TunedSetting& setting)
{
    std::string text;
    if (setting.method) {
        text += setting.method->name + ", ";
        for (const auto& [key, value] : method_keys(setting)) {
            if (value != setting.keys->find(key)->default_value) {
                text += fmt::format("{} = {}, ", bare_name(key), scene::to_toml(value));
            }
        }
    }
    return text;
}

} // namespace

std::string tuned_setting_line(const TunedSetting& setting)
{
    const ViewOutcome pooled = setting.pooled();
    return fmt::format("{}{}{}: false shadow {}, false lit {}", method_text(setting),
                       map_name(setting), tried_text(setting), percent(pooled.shadow_rate()),
                       percent(pooled.light_rate()));
}

TunedSetting own_setting(const scene::Job& job)
{
    TunedSetting own{
        job.shadow_map, job.lookup.filter, job.bias.slope, job.bias.normal_texels, {}, {}, {}};
    own.map.layout = scene::map_layout(job);
    own.bias.rounded.key = fmt::format("{} = {}", scene::bias_unit_of(job.bias).key,
                                       scene::constant_in_unit(job.bias));
    return own;
}

std::string best_toml(const TunedLight& tuned)
{
    const TuneResult& result = tuned.result;
    return tune_toml(result.best(), result.views.front().job.shadow_map.frustum.fit, tuned.light);
}

namespace {

/// TOML tables, one per line.
class InlineTables {
public:
    /// @param table  "[shadow_map]"; for a light "[lights.shadow_map]".
    /// @param line   "KEY = VALUE", with an optional comment.
    void add(const std::string& table, const std::string& line)
    {
        const std::size_t begin = table.find_last_of("[.") + 1;
        const std::string name = table.substr(begin, table.find(']') - begin);
        if (lines_.empty() || lines_.back().name != name) {
            lines_.push_back({name, {}, {}});
        }
        const std::size_t comment = line.find(" # ");
        lines_.back().keys.push_back(line.substr(0, comment));
        lines_.back().comment += comment == std::string::npos ? "" : line.substr(comment);
    }
    /// "bias = { constant = 0.002, slope = 0 }", one line per table.
    [[nodiscard]] std::string text() const
    {
        std::string text;
        for (const auto& [name, keys, comment] : lines_) {
            text += fmt::format("{} = {{ {} }}{}\n", name, fmt::join(keys, ", "), comment);
        }
        return text;
    }

private:
    struct Line {
        std::string name;
        std::vector<std::string> keys;
        std::string comment;
    };
    std::vector<Line> lines_;
};

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::size_t begin = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos;
         end = text.find('\n', begin)) {
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

} // namespace

std::string changed_toml(const TunedLight& tuned)
{
    const scene::Job& job = tuned.result.views.front().job;
    const scene::Fit own_fit = job.shadow_map.frustum.fit;
    std::set<std::string> own; // each line behind its table
    std::string table;
    for (const std::string& line : lines_of(tune_toml(own_setting(job), own_fit, tuned.light))) {
        table = line.starts_with('[') ? line : table;
        own.insert(table + line);
    }
    InlineTables changed;
    for (const std::string& line : lines_of(best_toml(tuned))) {
        if (line.starts_with('[')) {
            table = line;
        } else if (!own.contains(table + line)) {
            changed.add(table, line);
        }
    }
    return changed.text();
}

} // namespace gnomon::reports
