#include "scene/job/source.hpp"

#include "scene/builtin/scenes.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/keys/keys.hpp"
#include "scene/job/lights.hpp"
#include "scene/job/presets/presets.hpp"
#include "scene/job/renderer_choice.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/sweep/sweep_axes.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <system_error>

namespace gnomon::scene {
namespace {

namespace fs = std::filesystem;

/// Members of a job file that are not keys.
const std::vector<std::string> file_members{"preset", "sweep", "case", "lights",
                                            std::string{renderer_key}};

/// The parameters of the chosen built-in, including defaults.
ParameterValues builtin_parameters(const BuiltinScene& builtin, const Settings& settings)
{
    Job given;
    for (const auto& [key, setting] : settings) {
        if (key.starts_with(parameter_prefix(builtin.name))) {
            setting.spec->set(given, setting.value);
        }
    }
    return complete_parameters(builtin, given.scene.parameters);
}

/// Gives a directional light its direction, from its position and target if necessary.
void complete_light(Job& job)
{
    if (job.light && !is_positional(job.light->type) && !job.light->direction &&
        !job.light->target && !job.light->sun) {
        job.light->direction = Vec3d{-0.4, -1, -0.3};
    }
}

/// A layer with one setting that comes from no file.
Layer single_setting(const KeyTable& keys, std::string_view key, const std::string& value,
                     const std::string& label)
{
    return {make_setting(find_written_key(keys, key), {value}, label)};
}

/// A built-in's own settings. Drops a bias in a unit of length unless the light is its own
/// directional one, and drops all system keys under a preset.
Layer builtin_layer(const Job& defaults, const BuiltinScene& builtin, const Settings& given,
                    bool has_preset)
{
    Layer layer = layer_from_job(defaults, builtin.name);
    if (has_preset) {
        layer = without_system_keys(std::move(layer));
    }
    const Setting* type = find_setting(given, "light.type");
    if (type != nullptr && std::get<std::string>(type->value) != "directional") {
        std::erase_if(layer, [](const Setting& setting) {
            return is_constant_bias(setting.spec->name) && setting.spec->name != bias_in_depth.key;
        });
    }
    return layer;
}

constexpr std::string_view position_key = "lookup.position";

/// The settings that all lights share if there are several, because they share receivers.
Layer layer_of_lights(const JobSource& source)
{
    return source.lights.empty() ? Layer{}
                                 : single_setting(*source.keys, position_key, "pixel", source.name);
}

void check_position(const JobSource& source, const Settings& settings)
{
    const Setting* position = find_setting(settings, position_key);
    if (!source.lights.empty() && position != nullptr &&
        std::get<std::string>(position->value) != "pixel") {
        throw InputError(
            fmt::format("{}: must be \"pixel\" with several lights, because they share their "
                        "receivers; remove it, or choose one light with --light",
                        position->label));
    }
}

/// The given settings of a light, the weakest first.
std::vector<Layer> given_layers(const JobSource& source, const CaseLayer* chosen, const Layer& axes,
                                std::string_view light)
{
    std::vector<Layer> layers{layer_of_lights(source), source.scene_lights, source.file};
    if (chosen != nullptr) {
        layers.push_back(chosen->layer);
    }
    layers.push_back(source.overrides);
    layers.push_back(axes);
    for (Layer& layer : layers) {
        check_lights(source.lights, layer);
        layer = layer_of_light(layer, light);
    }
    if (source.preset.preset != nullptr) {
        const std::vector<Layer> under =
            preset_layers(source.preset.preset.get(), lay_all(layers),
                          !source.lights.empty() || !source.scene_lights.empty());
        layers.insert(layers.begin(), under.begin(), under.end());
    }
    return layers;
}

bool takes_all_lights(const Settings& settings)
{
    const Setting* lights = find_setting(settings, "scene.lights");
    return lights != nullptr && std::get<std::string>(lights->value) == "all";
}

/// With scene.lights = "all", adds the scene file's lights before those of the job.
void add_scene_lights(JobSource& source)
{
    const Settings settings = lay_all({source.file, source.overrides});
    if (!takes_all_lights(settings)) {
        return;
    }
    const Setting* file = find_setting(settings, "scene.file");
    if (file == nullptr) {
        throw InputError(fmt::format(
            "{}: only a scene.file can bring lights; remove it, or give lights under [[lights]]",
            settings.at("scene.lights").label));
    }
    Job job; // only its file space is set
    for (const std::string_view key : {"scene.unit_m", "scene.up"}) {
        if (const Setting* setting = find_setting(settings, key)) {
            setting->spec->set(job, setting->value);
        }
    }
    LightTables tables = read_file_lights(
        *source.keys, source.folder / std::get<std::string>(file->value), job.scene.file_space());
    for (std::string& name : source.lights) {
        if (std::ranges::find(tables.names, name) == tables.names.end()) {
            tables.names.push_back(std::move(name));
        }
    }
    source.lights = std::move(tables.names);
    source.scene_lights = std::move(tables.layer);
}

/// The lights come from one file, which is read before cases and axes are applied.
void check_scene_lights(const JobSource& source, const Settings& settings)
{
    const Settings read = lay_all({source.file, source.overrides});
    const auto text_of = [](const Settings& all, std::string_view key) {
        const Setting* setting = find_setting(all, key);
        return setting == nullptr ? std::string{} : to_toml(setting->value);
    };
    if (!takes_all_lights(settings) && !takes_all_lights(read)) {
        return;
    }
    for (const std::string_view key : {"scene.lights", "scene.file", "scene.unit_m", "scene.up"}) {
        if (text_of(settings, key) != text_of(read, key)) {
            const Setting* setting = find_setting(settings, key);
            throw InputError(
                fmt::format("{}: scene.lights = \"all\" takes the lights of one file; set both, "
                            "its unit and its up axis outside of cases and axes",
                            setting == nullptr ? source.name : setting->label));
        }
    }
}

/// Checks all settings of lights, used or not.
void check_all_lights(const JobSource& source)
{
    check_lights(source.lights, source.file);
    check_lights(source.lights, source.overrides);
    for (const CaseLayer& each : source.cases) {
        check_lights(source.lights, each.layer);
    }
}

void add_overrides(JobSource& source, const std::vector<Override>& overrides)
{
    source.overrides = layer_from_overrides(*source.keys, overrides);
    add_scene_lights(source);
    check_all_lights(source);
}

void check_axis_lights(const JobSource& source)
{
    for (const SweepAxis& axis : source.sweep.axes) {
        const std::string light = find_written_key(*source.keys, axis.key).light;
        if (!light.empty() && std::ranges::find(source.lights, light) == source.lights.end()) {
            throw InputError(fmt::format("{}: [sweep] {}: the job has no light of that name; the "
                                         "nearest is {}",
                                         source.name, axis.key,
                                         nearest_word(light, source.lights)));
        }
    }
}

/// The caller has already asked for the renderer, unless the job comes from a pipe.
void require_known_renderer(const fs::path& path, const std::string& name)
{
    std::error_code error;
    if (fs::is_fifo(path, error)) {
        throw InputError(fmt::format("{}: renderer = \"{}\": a pipe can be read only once; name "
                                     "the renderer with --renderer, and remove the key",
                                     one_line(path.string()), name));
    }
}

/// Reads the members of a job file's text.
void read_members(JobSource& source, const fs::path& path, std::string_view text)
{
    source.folder = path.parent_path();
    TomlTable keys;
    LightTables lights;
    for (TomlMember& member : parse_toml(text, source.name)) {
        if (member.key == "case") {
            source.cases = read_cases(*source.keys, member, source.name);
        } else if (member.key == "sweep") {
            source.sweep = read_sweep(*source.keys, member, source.name);
        } else if (member.key == "lights") {
            lights = read_light_tables(*source.keys, member, source.name);
        } else if (member.key == "preset") {
            source.preset = read_preset_choice(*source.keys, member, source.name);
        } else if (member.key == renderer_key) {
            require_known_renderer(path, read_renderer_choice(member, source.name));
        } else {
            refuse_renderer_command(member, source.name);
            keys.push_back(std::move(member));
        }
    }
    source.file = layer_from_table(*source.keys, keys, source.name, "", file_members);
    std::ranges::move(lights.layer, std::back_inserter(source.file));
    source.lights = std::move(lights.names);
}

} // namespace

JobSource read_job_source(const fs::path& path, const std::vector<Override>& overrides,
                          std::string_view preset, Keys keys)
{
    const std::string name = one_line(path.string());
    return job_source_of_text(
        path, is_scene_file(path) ? std::string{} : read_text_file(path, name, "job file"),
        overrides, preset, std::move(keys));
}

JobSource job_source_of_text(const fs::path& path, std::string_view text,
                             const std::vector<Override>& overrides, std::string_view preset,
                             Keys keys)
{
    JobSource source;
    source.keys = std::move(keys);
    source.name = one_line(path.string());
    if (is_scene_file(path)) {
        source.file = single_setting(*source.keys, "scene.file", path.string(), source.name);
    } else {
        read_members(source, path, text);
    }
    if (!preset.empty()) {
        source.preset = choose_preset(*source.keys, preset);
    }
    add_overrides(source, overrides);
    return source;
}

JobSource builtin_job_source(std::string_view name, const std::vector<Override>& overrides,
                             std::string_view preset, Keys keys)
{
    JobSource source;
    source.keys = std::move(keys);
    source.name = one_line(fmt::format("--builtin {}", name));
    source.preset = choose_preset(*source.keys, preset);
    source.file = single_setting(*source.keys, "scene.builtin", std::string{name}, source.name);
    add_overrides(source, overrides);
    return source;
}

JobSource preset_job_source(std::string_view preset, const std::vector<Override>& overrides,
                            Keys keys)
{
    JobSource source;
    source.keys = std::move(keys);
    source.preset = choose_preset(*source.keys, preset);
    source.name = source.preset.label;
    if (source.preset.preset->own_scene.empty()) {
        throw InputError(
            source.name +
            ": it has no scene of its own; add a job file, a scene file or --builtin NAME");
    }
    add_overrides(source, overrides);
    return source;
}

const CaseLayer& find_case(const JobSource& source, std::string_view name)
{
    std::vector<std::string> names;
    for (const CaseLayer& each : source.cases) {
        if (each.name == name) {
            return each;
        }
        names.push_back(each.name);
    }
    const std::string quoted = toml_excerpt({std::string{name}});
    if (names.empty()) {
        throw InputError(
            fmt::format("{}: no case {}: the job defines no [[case]]", source.name, quoted));
    }
    throw InputError(fmt::format("{}: no case {}; the nearest is {}", source.name, quoted,
                                 toml_excerpt({nearest_word(name, names)})));
}

JobSource only_light(const JobSource& source, std::string_view light)
{
    require_light(source.lights, light, source.name);
    check_axis_lights(source);
    JobSource only = source;
    only.lights.clear();
    const auto reduce = [&](Layer& layer) {
        check_lights(source.lights, layer);
        layer = layer_of_light(layer, light);
    };
    reduce(only.scene_lights);
    const Layer common = layer_of_lights(source);
    only.scene_lights.insert(only.scene_lights.begin(), common.begin(), common.end());
    reduce(only.file);
    reduce(only.overrides);
    for (CaseLayer& each : only.cases) {
        reduce(each.layer);
    }
    only.sweep.axes = axes_of_light(*source.keys, source.sweep.axes, light);
    return only;
}

Job make_job(const JobSource& source, const CaseLayer* chosen, const Layer& axes,
             std::string_view light)
{
    if (light.empty() && !source.lights.empty()) {
        throw InputError(fmt::format("{}: the job has several lights: choose one with --light, {}",
                                     source.name, fmt::join(source.lights, " or ")));
    }
    std::vector<Layer> layers = given_layers(source, chosen, axes, light);
    Settings settings = lay_all(layers);
    check_scene_choice(*source.keys, settings, source.name);
    check_scene_lights(source, settings);
    if (const Setting* choice = find_setting(settings, "scene.builtin")) {
        const auto& builtin = find_builtin_scene(std::get<std::string>(choice->value));
        Job defaults = builtin.default_job(builtin_parameters(builtin, settings));
        defaults.keys = source.keys;
        defaults.method.name = source.keys->default_method();
        layers.insert(layers.begin(),
                      builtin_layer(defaults, builtin, settings, source.preset.preset != nullptr));
        settings = lay_all(layers);
    }
    check_preset_light(source.preset, settings);
    check_settings(*source.keys, settings, source.name);
    check_position(source, settings);
    Job job;
    job.keys = source.keys;
    job.method.name = source.keys->default_method();
    for (const Key& spec : source.keys->rows()) {
        if (const Setting* setting = find_setting(settings, spec.name)) {
            spec.set(job, setting->value);
        }
    }
    complete_light(job);
    if (!job.scene.file.empty()) {
        job.scene.file = source.folder / job.scene.file;
    }
    return job;
}

std::vector<std::pair<std::string, std::string>> given_keys(const JobSource& source,
                                                            const CaseLayer* chosen,
                                                            const Layer& axes,
                                                            std::string_view light)
{
    const Settings settings = lay_all(given_layers(source, chosen, axes, light));
    std::vector<std::pair<std::string, std::string>> keys;
    for (const Key& spec : source.keys->rows()) {
        if (const Setting* setting = find_setting(settings, spec.name)) {
            keys.emplace_back(spec.name, to_toml(setting->value));
        }
    }
    return keys;
}

JobSource with_preset(const JobSource& source, const CaseLayer* chosen, const Preset& preset)
{
    const Settings settings =
        lay_all({without_system_keys(source.file),
                 chosen == nullptr ? Layer{} : without_system_keys(chosen->layer), preset.job});
    JobSource other = source;
    other.preset = {std::make_shared<const Preset>(preset), fmt::format("preset {}", preset.name)};
    other.file.clear();
    for (const auto& [key, setting] : settings) {
        other.file.push_back(setting);
    }
    other.cases.clear();
    other.sweep = {};
    return other;
}

} // namespace gnomon::scene
