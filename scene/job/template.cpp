#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/keys/keys.hpp"
#include "scene/job/presets/presets.hpp"
#include "scene/job/source.hpp"

#include <fmt/format.h>

#include <map>

namespace gnomon::scene {
namespace {

constexpr std::string_view shown_builtin = "sphere-cube"; // under a spot
constexpr std::string_view shown_sun = "wall";

constexpr std::string_view heading =
    R"(# A job: what to look at and how. Every key may be left out: it then takes the value that the
# built-in scene brings along, or for a scene file the default named here. Without [camera] and
# [light], a scene file's own are used, or else a camera that frames it and the default light.

# The shadow map of a lesson or an engine, for what this file leaves out: `gnomon presets`.
# preset = "lesson-webgl"
)";

constexpr std::string_view lights_sweep_and_cases = R"(
# Several lights in place of [light]: each has a name, its keys without their table, and where it
# wants its own of [shadow_map], [lookup], [bias] and [method].
# [[lights]]
# name = "lamp"
# type = "point"
# position = [0, 3, 0]
# shadow_map.resolution = 512

# Axes of `gnomon sweep`: a key and a list of its values, or a range of them.
# [sweep]
# "bias.constant" = {from = 1e-6, to = 1e-1, count = 200, scale = "log"}   # scale: linear, log
# "shadow_map.resolution" = [512, 1024, 2048, 4096]
# mode = "product"   # product: every combination; zip: the axes side by side
# sample = 0         # take so many configurations at random; 0: all of them
# seed = 0           # of that choice

# Variants of the job (`--case NAME`): a name, and the keys that differ.
# [[case]]
# name = "fine"
# shadow_map.resolution = 4096
)";

/// The table of a key: "scene.wall" for "scene.wall.thickness_m".
std::string_view table_of(std::string_view key)
{
    return key.substr(0, key.rfind('.'));
}

/// The key with its description and range, commented out if the job omits it.
std::string entry(const Key& key, const std::map<std::string, std::string>& values)
{
    const std::string default_note =
        key.default_text.empty() ? "" : fmt::format("; default {}", key.default_text);
    const auto value = values.find(key.name);
    const std::string& shown = key.default_text.empty() ? key.example : key.default_text;
    return fmt::format("# {}\n#   {}{}\n{}{} = {}\n", key.description, key.range_text, default_note,
                       value == values.end() ? "# " : "", key_leaf(key.name),
                       value == values.end() ? shown : value->second);
}

/// The job that is written out.
Job shown_job(std::string_view preset, const Keys& keys)
{
    if (preset.empty()) {
        return builtin_job(shown_builtin, {}, keys).job;
    }
    const Preset chosen = find_preset(*keys, preset, fmt::format("--preset {}", preset));
    if (!chosen.own_scene.empty()) {
        return job_of(preset_job_source(preset, {}, keys)).job;
    }
    const std::string_view builtin = chosen.is_for(LightType::spot) ? shown_builtin : shown_sun;
    return job_of(builtin_job_source(builtin, {}, preset, keys)).job;
}

} // namespace

std::string commented_job_file(std::string_view preset, const Keys& keys)
{
    const Job job = shown_job(preset, keys);
    std::map<std::string, std::string> values;
    for (auto& [key, value] : resolved_keys(job)) {
        values.emplace(key, std::move(value));
    }
    std::string text{heading};
    std::string_view table;
    for (const Key& spec : keys->rows()) {
        const bool is_shown = !table_of(spec.name).starts_with("scene.") ||
                              spec.name.starts_with(parameter_prefix(job.scene.builtin));
        if (!is_shown) {
            continue;
        }
        if (table_of(spec.name) != table) {
            table = table_of(spec.name);
            text += fmt::format("\n[{}]\n", table);
        }
        text += entry(spec, values);
    }
    return text + std::string{lights_sweep_and_cases};
}

} // namespace gnomon::scene
