#include "scene/job/presets/presets.hpp"

#include "scene/error.hpp"
#include "scene/nearest_word.hpp"

#include <fmt/format.h>

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

/// Its keys over those of what it is based on, or of its engine's own defaults.
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

} // namespace gnomon::scene
