#include "scene/job/presets/presets.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::scene {
namespace {

[[noreturn]] void refuse_preset(std::string_view name, std::string_view why)
{
    throw InputError(fmt::format("preset {}: {}", name, why));
}

const std::string& text_of_member(std::string_view preset, const TomlMember& member)
{
    const auto* text = std::get_if<std::string>(&member.node.value);
    if (text == nullptr || text->empty()) {
        refuse_preset(preset, fmt::format("{} must be a text", member.key));
    }
    return *text;
}

std::vector<std::string> texts_of_member(std::string_view preset, const TomlMember& member)
{
    const auto* array = std::get_if<TomlArray>(&member.node.value);
    if (array == nullptr) {
        refuse_preset(preset, fmt::format("{} must be a list of texts", member.key));
    }
    std::vector<std::string> texts;
    for (const TomlNode& node : *array) {
        texts.push_back(text_of_member(preset, {member.key, node}));
    }
    return texts;
}

LightType light_of_word(std::string_view preset, const std::string& word)
{
    const auto type = light_type_from_name(word);
    if (!type) {
        refuse_preset(preset, fmt::format("there is no light {}", word));
    }
    return *type;
}

PresetKind kind_of_word(std::string_view preset, const std::string& word)
{
    for (const PresetKind kind : {PresetKind::lesson, PresetKind::engine}) {
        if (word == preset_kind_name(kind)) {
            return kind;
        }
    }
    refuse_preset(preset, fmt::format("there is no kind {}", word));
}

const TomlTable& table_of_member(std::string_view preset, const TomlMember& member)
{
    const auto* table = std::get_if<TomlTable>(&member.node.value);
    if (table == nullptr) {
        refuse_preset(preset, fmt::format("{} must be a table", member.key));
    }
    return *table;
}

/// Lays the preset's keys over those of its base, or of its engine's own defaults.
void lay_keys(const KeyTable& keys, Layer& layer, std::string_view preset, const TomlTable& table)
{
    const std::string file = fmt::format("preset {}", preset);
    for_each_key(
        keys, table, file, {}, [&](const WrittenKey& key, const TomlNode& node, const KeyPlace&) {
            std::erase_if(layer, [&](const Setting& base) { return base.spec == key.spec; });
            layer.push_back(make_setting(
                key, node, fmt::format("{}: {} = {}", file, key.text(), toml_excerpt(node))));
        });
}

void read_preset_member(const KeyTable& keys, Preset& preset, const TomlMember& member)
{
    const std::string& name = preset.name;
    if (member.key == "kind") {
        preset.kind = kind_of_word(name, text_of_member(name, member));
    } else if (member.key == "sentence") {
        preset.sentence = text_of_member(name, member);
    } else if (member.key == "source") {
        preset.source = text_of_member(name, member);
    } else if (member.key == "own_bias") {
        preset.own_bias = text_of_member(name, member);
    } else if (member.key == "cannot") {
        preset.cannot = texts_of_member(name, member);
    } else if (member.key == "lights") {
        preset.lights.clear();
        for (const std::string& word : texts_of_member(name, member)) {
            preset.lights.push_back(light_of_word(name, word));
        }
    } else if (member.key == "job") {
        lay_keys(keys, preset.job, name, table_of_member(name, member));
    } else if (member.key == "own_scene") {
        lay_keys(keys, preset.own_scene, name, table_of_member(name, member));
    } else if (member.key != "based_on" && member.key != "engine") {
        refuse_preset(name, fmt::format("unknown member {}", member.key));
    }
}

void check_preset(const Preset& preset)
{
    for (const auto& [member, is_missing] : {std::pair{"sentence", preset.sentence.empty()},
                                             {"source", preset.source.empty()},
                                             {"own_bias", preset.own_bias.empty()},
                                             {"cannot", preset.cannot.empty()},
                                             {"lights", preset.lights.empty()},
                                             {"job", preset.job.empty()}}) {
        if (is_missing) {
            refuse_preset(preset.name, fmt::format("{} is missing", member));
        }
    }
}

TomlTable parse_preset(std::string_view name, std::string_view text)
{
    return parse_toml(text, fmt::format("preset {}", name));
}

} // namespace

std::string_view preset_kind_name(PresetKind kind)
{
    switch (kind) {
    case PresetKind::lesson:
        return "lesson";
    case PresetKind::engine:
        return "engine";
    }
    return {};
}

bool Preset::is_for(LightType type) const
{
    return std::ranges::find(lights, type) != lights.end();
}

std::vector<Preset> presets(const KeyTable& keys)
{
    std::vector<Preset> all;
    for (const PresetFile& file : preset_files()) {
        const std::string_view name = file.name.substr(0, file.name.rfind('.'));
        const std::string base = base_of_preset(name, file.text);
        const auto found = std::ranges::find(all, base, &Preset::name);
        if (!base.empty() && found == all.end()) {
            refuse_preset(name, fmt::format("based on {}, which does not stand before it", base));
        }
        all.push_back(read_preset(keys, name, file.text, base.empty() ? nullptr : &*found));
    }
    return all;
}

std::vector<std::string> engine_names()
{
    std::vector<std::string> names;
    for (const PresetFile& file : preset_files()) {
        if (file.text.find("\n[engine]\n") != std::string_view::npos) {
            names.emplace_back(file.name.substr(0, file.name.rfind('.')));
        }
    }
    return names;
}

Preset find_engine(const KeyTable& keys, std::string_view name, std::string_view label,
                   std::span<const std::string_view> more)
{
    const std::string word = lower_case(name);
    std::vector<std::string> names;  // that are taken
    std::vector<std::string> listed; // "unity (urp, unity-urp)"
    for (Preset& preset : presets(keys)) {
        if (!preset.engine) {
            continue;
        }
        const std::vector<std::string>& aliases = preset.engine->aliases;
        if (preset.name == word || std::ranges::find(aliases, word) != aliases.end()) {
            return std::move(preset);
        }
        names.push_back(preset.name);
        names.insert(names.end(), aliases.begin(), aliases.end());
        listed.push_back(aliases.empty()
                             ? preset.name
                             : fmt::format("{} ({})", preset.name, fmt::join(aliases, ", ")));
    }
    names.insert(names.end(), more.begin(), more.end());
    listed.insert(listed.end(), more.begin(), more.end());
    throw InputError(fmt::format("{}: unknown engine; the nearest is {} (of {})", label,
                                 nearest_word(word, names), fmt::join(listed, ", ")));
}

Preset find_preset(const KeyTable& keys, std::string_view name, std::string_view label)
{
    std::vector<std::string> names;
    for (Preset& preset : presets(keys)) {
        if (preset.name == name) {
            return std::move(preset);
        }
        names.push_back(preset.name);
    }
    throw InputError(fmt::format("{}: no preset of that name; the nearest is {} (`gnomon presets`)",
                                 label, nearest_word(name, names)));
}

std::string base_of_preset(std::string_view name, std::string_view text)
{
    for (const TomlMember& member : parse_preset(name, text)) {
        if (member.key == "based_on") {
            return text_of_member(name, member);
        }
    }
    return {};
}

Preset read_preset(const KeyTable& keys, std::string_view name, std::string_view text,
                   const Preset* base)
{
    Preset preset;
    if (base != nullptr) {
        preset.job = base->job;
        preset.own_scene = base->own_scene;
    }
    preset.name = name;
    const TomlTable members = parse_preset(name, text);
    if (const auto own = std::ranges::find(members, "engine", &TomlMember::key);
        own != members.end()) {
        auto [engine, job] = read_engine(keys, name, table_of_member(name, *own));
        preset.engine = std::move(engine);
        lay_keys(keys, preset.job, name, job);
    }
    for (const TomlMember& member : members) {
        read_preset_member(keys, preset, member);
    }
    check_preset(preset);
    return preset;
}

bool is_system_key(std::string_view key)
{
    constexpr std::array<std::string_view, 6> of_place{
        "shadow_map.fit",      "shadow_map.half_extent", "shadow_map.fov_deg",
        "shadow_map.roll_deg", "shadow_map.near",        "shadow_map.far"};
    return key.starts_with("method.") || key.starts_with("lookup.") || key.starts_with("bias.") ||
           (key.starts_with("shadow_map.") && std::ranges::find(of_place, key) == of_place.end());
}

namespace {

/// The light's type, if the settings give one; empty if the scene decides.
std::string_view light_word(const Settings& settings)
{
    if (const Setting* type = find_setting(settings, "light.type")) {
        return std::get<std::string>(type->value);
    }
    const auto first = settings.lower_bound("light.");
    const bool has_light = first != settings.end() && first->first.starts_with("light.");
    return has_light ? light_type_name(LightSettings{}.type) : std::string_view{};
}

} // namespace

ChosenPreset choose_preset(const KeyTable& keys, std::string_view name)
{
    if (name.empty()) {
        return {};
    }
    std::string label = one_line(fmt::format("--preset {}", name));
    return {std::make_shared<const Preset>(find_preset(keys, name, label)), std::move(label)};
}

ChosenPreset read_preset_choice(const KeyTable& keys, const TomlMember& member,
                                const std::string& file)
{
    std::string label =
        fmt::format("{}preset = {}", KeyPlace{file, member.line}.text(), toml_excerpt(member.node));
    const auto* name = std::get_if<std::string>(&member.node.value);
    if (name == nullptr || name->empty()) {
        throw InputError(label + ": must be the name of a preset (`gnomon presets`)");
    }
    return {std::make_shared<const Preset>(find_preset(keys, *name, label)), std::move(label)};
}

std::vector<Layer> preset_layers(const Preset* preset, const Settings& given, bool has_lights)
{
    if (preset == nullptr) {
        return {};
    }
    if (find_setting(given, "scene.builtin") != nullptr ||
        find_setting(given, "scene.file") != nullptr) {
        return {preset->job};
    }
    Layer own_scene = preset->own_scene;
    if (has_lights) {
        std::erase_if(own_scene, [](const Setting& setting) {
            return setting.spec->name.starts_with("light.");
        });
    }
    return {preset->job, std::move(own_scene)};
}

void check_preset_light(const ChosenPreset& chosen, const Settings& settings)
{
    const std::string_view light = light_word(settings);
    if (chosen.preset == nullptr || light.empty()) {
        return;
    }
    std::vector<std::string_view> names;
    for (const LightType type : chosen.preset->lights) {
        names.push_back(light_type_name(type));
    }
    if (std::ranges::find(names, light) == names.end()) {
        throw InputError(fmt::format(
            "{}: it supports a {} light, but the job's is {}; choose another (`gnomon presets`)",
            chosen.label, fmt::join(names, " or "), light));
    }
}

Layer without_system_keys(Layer layer)
{
    std::erase_if(layer, [](const Setting& setting) { return is_system_key(setting.spec->name); });
    return layer;
}

} // namespace gnomon::scene
