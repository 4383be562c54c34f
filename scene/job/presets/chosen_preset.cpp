#include "scene/job/presets/chosen_preset.hpp"

#include "scene/error.hpp"
#include "scene/job/presets/presets.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace gnomon::scene {
namespace {

/// What the settings say of the light; empty where they leave it to the scene.
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
        throw InputError(fmt::format("{}: it is for a {} light, and the job's is {}; take another "
                                     "(`gnomon presets`)",
                                     chosen.label, fmt::join(names, " or "), light));
    }
}

Layer without_system_keys(Layer layer)
{
    std::erase_if(layer, [](const Setting& setting) { return is_system_key(setting.spec->name); });
    return layer;
}

} // namespace gnomon::scene
