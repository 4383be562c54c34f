#include "scene/job/setting_layers.hpp"

#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/keys/keys.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

namespace gnomon::scene {
namespace {

/// Setting `key` (to `word`, unless empty) in an upper layer drops other keys from lower layers.
struct Replacement {
    std::string_view key;
    std::string_view word;
    std::array<std::string_view, 4> drops;
};

constexpr std::array<std::string_view, 3> sun_keys{"light.sun.latitude_deg",
                                                   "light.sun.longitude_deg", "light.sun.time"};

constexpr std::array<Replacement, 15> replacements{{
    {"scene.builtin", "", {"scene.file", "scene.unit_m", "scene.up"}},
    {"scene.file", "", {"scene.builtin"}},
    {"camera.vertical_fov_deg", "", {"camera.orthographic_height"}},
    {"camera.orthographic_height", "", {"camera.vertical_fov_deg"}},
    {"light.type", "point", {"shadow_map.fit", "shadow_map.roll_deg", "lookup.position"}},
    {"light.direction", "", {sun_keys[0], sun_keys[1], sun_keys[2]}},
    {"light.target", "", {"light.direction", sun_keys[0], sun_keys[1], sun_keys[2]}},
    {sun_keys[0], "", {"light.direction"}},
    {sun_keys[1], "", {"light.direction"}},
    {sun_keys[2], "", {"light.direction"}},
    {"shadow_map.fit", "scene", {"shadow_map.half_extent", "shadow_map.fov_deg"}},
    {"shadow_map.fit", "camera", {"shadow_map.half_extent", "shadow_map.fov_deg"}},
    {"shadow_map.layout",
     "cascades",
     {"shadow_map.fit", "shadow_map.half_extent", "lookup.position"}},
    {"shadow_map.split", "uniform", {"shadow_map.split_lambda"}},
    {"shadow_map.split", "logarithmic", {"shadow_map.split_lambda"}},
}};

bool is_parameter(std::string_view key)
{
    return key.starts_with("scene.") && std::count(key.begin(), key.end(), '.') == 2;
}

/// Choosing another scene drops the parameters of the previous one.
void drop_parameters(Settings& settings, const Setting& choice)
{
    const auto* builtin = std::get_if<std::string>(&choice.value);
    const std::string kept = choice.spec->name == "scene.builtin" ? parameter_prefix(*builtin) : "";
    std::erase_if(settings, [&](const auto& entry) {
        return is_parameter(entry.first) && (kept.empty() || !entry.first.starts_with(kept));
    });
}

/// Choosing another type of light drops the keys that it does not have.
void drop_keys_of_other_lights(Settings& settings, LightType light)
{
    std::erase_if(settings,
                  [light](const auto& entry) { return !entry.second.spec->is_of(light); });
}

/// Choosing another light drops a layout that it cannot have; another layout drops the keys of
/// cascades.
void drop_layout(Settings& settings, const Setting& choice)
{
    const std::string& word = std::get<std::string>(choice.value);
    const bool is_layout = choice.spec->name == "shadow_map.layout";
    const Setting* layout = find_setting(settings, "shadow_map.layout");
    const bool had_cascades =
        layout != nullptr && std::get<std::string>(layout->value) == "cascades";
    if (!is_layout && !(word == "directional" && had_cascades)) {
        settings.erase("shadow_map.layout");
    }
    if (is_layout ? word != "cascades" : word != "directional") {
        std::erase_if(settings, [](const auto& entry) { return is_cascade_key(entry.first); });
    }
}

void drop_replaced(Settings& settings, const Setting& setting)
{
    const std::string& key = setting.spec->name;
    const auto* word = std::get_if<std::string>(&setting.value);
    for (const Replacement& replacement : replacements) {
        if (key == replacement.key &&
            (replacement.word.empty() || (word != nullptr && *word == replacement.word))) {
            for (const std::string_view dropped : replacement.drops) {
                settings.erase(std::string{dropped});
            }
        }
    }
    if (key == "light.type") {
        drop_keys_of_other_lights(settings, light_type_from_name(*word).value());
    }
    if (is_constant_bias(key)) {
        std::erase_if(settings, [&](const auto& entry) {
            return entry.first != key && is_constant_bias(entry.first);
        });
    }
    if (key == "light.type" || key == "shadow_map.layout") {
        drop_layout(settings, setting);
    }
    if (key == "scene.builtin" || key == "scene.file") {
        drop_parameters(settings, setting);
    }
    // Position and target together give a direction. Position alone places the directional light's
    // camera, so it stays.
    if ((key == "light.direction" || key.starts_with("light.sun.")) &&
        settings.erase("light.target") != 0) {
        settings.erase("light.position");
    }
}

/// Names of the tables that hold keys.
std::vector<std::string> table_names(const KeyTable& keys)
{
    std::set<std::string> names;
    for (const Key& spec : keys.rows()) {
        for (auto dot = spec.name.find('.'); dot != std::string::npos;
             dot = spec.name.find('.', dot + 1)) {
            names.insert(spec.name.substr(0, dot));
        }
    }
    return {names.begin(), names.end()};
}

[[noreturn]] void throw_unknown(const KeyTable& keys, const std::string& name, const TomlNode& node,
                                const KeyPlace& place, const std::vector<std::string>& siblings)
{
    if (is_preset_key(name)) {
        throw InputError(fmt::format("{}{}: {}", place.text(), name, preset_place));
    }
    if (is_engine_key(name) && !keys.has_table("engine")) {
        throw InputError(fmt::format("{}{}: {}", place.text(), toml_excerpt({name}), engine_place));
    }
    if (!std::holds_alternative<TomlTable>(node.value)) {
        throw InputError(fmt::format("{}unknown key {}; the nearest is {}", place.text(),
                                     toml_excerpt({name}),
                                     nearest_written_key(keys, name, siblings)));
    }
    std::vector<std::string> names = table_names(keys);
    names.insert(names.end(), siblings.begin(), siblings.end());
    const bool is_misplaced = std::find(names.begin(), names.end(), key_leaf(name)) != names.end();
    throw InputError(
        fmt::format("{}unknown table {}; the nearest is {}", place.text(), toml_excerpt({name}),
                    nearest_word(is_misplaced ? key_leaf(name) : std::string_view{name}, names)));
}

/// The arguments shared by all visited tables.
struct Visit {
    const KeyTable& keys;
    const std::string& file;
    const std::vector<std::string>& siblings;
    const KeyVisitor& visitor;
};

void visit_table(const TomlTable& table, const std::string& prefix, const Visit& visit)
{
    for (const TomlMember& member : table) {
        const KeyPlace place{visit.file, member.line};
        const std::string name = prefix + member.key;
        const auto* nested = std::get_if<TomlTable>(&member.node.value);
        if (const WrittenKey key = find_written_key(visit.keys, name)) {
            visit.visitor(key, member.node, place);
        } else if (!is_written_table(visit.keys, name)) {
            throw_unknown(visit.keys, name, member.node, place, visit.siblings);
        } else if (nested != nullptr) {
            visit_table(*nested, name + ".", visit);
        } else {
            throw InputError(fmt::format("{}{} = {}: must be a table, [{}]", place.text(), name,
                                         toml_excerpt(member.node), name));
        }
    }
}

/// The value of `--set key=value`: TOML, or a bare word for a string.
TomlNode override_value(const std::string& value, const std::string& label)
{
    if (auto node = parse_toml_value(value)) {
        return std::move(*node);
    }
    if (value.empty() || std::string_view{"[{\"'"}.find(value.front()) != std::string_view::npos) {
        throw InputError(label + ": not a TOML value (a number, a word, \"a text\", [a, list])");
    }
    return {value};
}

} // namespace

std::string KeyPlace::text() const
{
    return fmt::format("{}:{}: ", file, line);
}

Setting make_setting(const WrittenKey& key, const TomlNode& node, std::string label)
{
    auto value = read_value(key.spec->domain, node);
    if (!value) {
        throw InputError(fmt::format("{}: {}", label, refusal_text(key.spec->domain, node)));
    }
    return {key.spec, std::move(*value), std::move(label), key.light};
}

void for_each_key(const KeyTable& keys, const TomlTable& table, const std::string& file,
                  const std::vector<std::string>& siblings, const KeyVisitor& visit)
{
    visit_table(table, "", {keys, file, siblings, visit});
}

Layer layer_from_table(const KeyTable& keys, const TomlTable& table, const std::string& file,
                       const std::string& heading, const std::vector<std::string>& siblings)
{
    Layer layer;
    std::set<std::string> seen;
    for_each_key(keys, table, file, siblings,
                 [&](const WrittenKey& key, const TomlNode& node, const KeyPlace& place) {
                     const std::string name = key.text();
                     const std::string label = fmt::format("{}{}{} = {}", place.text(), heading,
                                                           name, toml_excerpt(node));
                     if (!seen.insert(name).second) {
                         throw InputError(label + ": the key is given twice; keep one");
                     }
                     layer.push_back(make_setting(key, node, label));
                 });
    return layer;
}

Layer layer_from_overrides(const KeyTable& keys, const std::vector<Override>& overrides)
{
    Layer layer;
    for (const Override& given : overrides) {
        const std::string label =
            one_line(fmt::format("{}{}={}", given.said_by, given.key, given.value));
        const WrittenKey key = find_written_key(keys, given.key);
        if (!key && is_preset_key(given.key)) {
            throw InputError(fmt::format("{}: {}", label, preset_place));
        }
        if (!key && is_engine_key(given.key) && !keys.has_table("engine")) {
            throw InputError(fmt::format("{}: {}", label, engine_place));
        }
        if (!key) {
            throw InputError(fmt::format("{}: unknown key; the nearest is {}", label,
                                         nearest_written_key(keys, given.key)));
        }
        std::erase_if(layer, [&](const Setting& earlier) {
            return earlier.spec == key.spec && earlier.light == key.light;
        });
        layer.push_back(make_setting(key, override_value(given.value, label), label));
    }
    return layer;
}

Layer layer_from_job(const Job& job, std::string_view builtin)
{
    Layer layer;
    for (const Key& spec : keys_of(job).rows()) {
        // Skips defaults, because they may depend on later layers.
        if (auto value = spec.get(job); value && value != default_of(spec, job)) {
            std::string label =
                fmt::format("built-in \"{}\": {} = {}", builtin, spec.name, to_toml(*value));
            layer.push_back({&spec, std::move(*value), std::move(label)});
        }
    }
    return layer;
}

const std::string* method_of(const Layer& layer, std::string_view light)
{
    const auto names_method = [&](const Setting& setting) {
        return setting.light == light && setting.spec->name == "method.name";
    };
    const auto found = std::ranges::find_if(layer, names_method);
    return found == layer.end() ? nullptr : &std::get<std::string>(found->value);
}

void drop_keys_of_other_methods(Layer& layer, std::string_view method)
{
    std::erase_if(layer, [&](const Setting& setting) { return !setting.spec->is_of(method); });
}

Layer layer_of_light(const Layer& layer, std::string_view light)
{
    Layer of_light;
    const std::string* const own_method = light.empty() ? nullptr : method_of(layer, light);
    for (const std::string_view whose : {std::string_view{}, light}) {
        if (whose == light && own_method != nullptr) {
            // A setting for all lights applies only to lights whose method has the key.
            drop_keys_of_other_methods(of_light, *own_method);
        }
        for (const Setting& setting : layer) {
            if (setting.light != whose) {
                continue;
            }
            // A light's own setting replaces the setting for all lights.
            std::erase_if(of_light, [&](const Setting& all) { return all.spec == setting.spec; });
            of_light.push_back(setting);
            of_light.back().light.clear();
        }
    }
    return of_light;
}

void refuse(const Setting& setting, std::string_view why)
{
    throw InputError(fmt::format("{}: {}", setting.label, why));
}

void lay_over(Settings& settings, const Layer& layer)
{
    for (const Setting& setting : layer) {
        drop_replaced(settings, setting);
    }
    for (const Setting& setting : layer) {
        settings.insert_or_assign(setting.spec->name, setting);
    }
}

Settings lay_all(std::vector<Layer> layers)
{
    const auto strongest =
        std::ranges::find_if(layers.rbegin(), layers.rend(),
                             [](const Layer& layer) { return method_of(layer) != nullptr; });
    if (strongest != layers.rend()) {
        const std::string method = *method_of(*strongest);
        for (auto weaker = std::next(strongest); weaker != layers.rend(); ++weaker) {
            drop_keys_of_other_methods(*weaker, method);
        }
    }
    Settings settings;
    for (const Layer& layer : layers) {
        lay_over(settings, layer);
    }
    return settings;
}

} // namespace gnomon::scene
