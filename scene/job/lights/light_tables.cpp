#include "scene/job/lights/light_tables.hpp"

#include "scene/error.hpp"
#include "scene/nearest_word.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace gnomon::scene {

namespace {

struct NamedTable {
    std::string name;
    std::uint32_t name_line = 0;
    TomlTable keys;
};

NamedTable read_table(const TomlNode& node, const std::string& file, std::uint32_t line)
{
    const std::string label = KeyPlace{file, line}.text() + "[[lights]]";
    const auto* table = std::get_if<TomlTable>(&node.value);
    if (table == nullptr) {
        throw InputError(label + ": must be a table with a name and keys of [light]");
    }
    NamedTable read;
    for (const TomlMember& member : *table) {
        if (member.key != "name") {
            read.keys.push_back(member);
            continue;
        }
        const auto* name = std::get_if<std::string>(&member.node.value);
        if (name == nullptr || !is_light_name(*name)) {
            throw InputError(fmt::format("{}:{}: [[lights]] name = {}: must be made of the letters "
                                         "a to z, digits, _ and -, 64 at most",
                                         file, member.line, toml_excerpt(member.node)));
        }
        read.name = *name;
        read.name_line = member.line;
    }
    if (read.name.empty()) {
        throw InputError(label + ": has no name; give it a name of its own");
    }
    return read;
}

[[noreturn]] void refuse(const Setting& setting, const std::string& why)
{
    throw InputError(fmt::format("{}: {}", setting.label, why));
}

} // namespace

LightTables read_light_tables(const KeyTable& keys, const TomlMember& member,
                              const std::string& file)
{
    const auto* array = std::get_if<TomlArray>(&member.node.value);
    const std::string place = KeyPlace{file, member.line}.text();
    if (array == nullptr || array->empty()) {
        throw InputError(place + "lights: must be tables, each headed [[lights]]");
    }
    if (array->size() > most_lights) {
        throw InputError(
            fmt::format("{}[[lights]]: {} lights; at most {}", place, array->size(), most_lights));
    }
    LightTables lights;
    for (const TomlNode& node : *array) {
        NamedTable read = read_table(node, file, member.line);
        if (std::ranges::find(lights.names, read.name) != lights.names.end()) {
            throw InputError(fmt::format("{}[[lights]] name = {}: two lights of that name; rename "
                                         "one",
                                         KeyPlace{file, read.name_line}.text(),
                                         toml_excerpt({read.name})));
        }
        // As if it stood in one table of all lights, under its name.
        TomlTable named{{read.name, {std::move(read.keys)}, member.line}};
        const TomlTable all{{"lights", {std::move(named)}, member.line}};
        Layer layer = layer_from_table(keys, all, file, "", {"name"});
        std::ranges::move(layer, std::back_inserter(lights.layer));
        lights.names.push_back(std::move(read.name));
    }
    return lights;
}

void check_lights(const std::vector<std::string>& names, const Layer& layer)
{
    for (const Setting& setting : layer) {
        if (setting.light.empty()) {
            if (!names.empty() && setting.spec->name.starts_with("light.")) {
                refuse(setting, fmt::format("the job has several lights; say it of one of them, "
                                            "e.g. {}",
                                            WrittenKey{setting.spec, names.front()}.text()));
            }
        } else if (names.empty()) {
            refuse(setting, fmt::format("the job has no [[lights]]; remove it, or say {} of its "
                                        "only light",
                                        setting.spec->name));
        } else if (std::ranges::find(names, setting.light) == names.end()) {
            refuse(setting, fmt::format("the job has no light of that name; the nearest is {}",
                                        nearest_word(setting.light, names)));
        }
    }
}

void require_light(const std::vector<std::string>& names, std::string_view light,
                   std::string_view source)
{
    if (names.empty()) {
        throw InputError(fmt::format("{}: no light {}: the job has but one, without a name", source,
                                     toml_excerpt({std::string{light}})));
    }
    if (std::ranges::find(names, light) == names.end()) {
        throw InputError(fmt::format("{}: no light {}; there are {}", source,
                                     toml_excerpt({std::string{light}}), fmt::join(names, ", ")));
    }
}

} // namespace gnomon::scene
