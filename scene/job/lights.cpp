#include "scene/job/lights.hpp"

#include "scene/error.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>
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
        // Wrapped as a table of all lights, so that its keys are read as "lights.NAME.KEY".
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
                refuse(setting,
                       fmt::format("the job has several lights; set it for one of them, e.g. {}",
                                   WrittenKey{setting.spec, names.front()}.text()));
            }
        } else if (names.empty()) {
            refuse(setting,
                   fmt::format("the job has no [[lights]]; remove it, or set {} for its only light",
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
        throw InputError(fmt::format("{}: no light {}: the job has only one light, without a name",
                                     source, toml_excerpt({std::string{light}})));
    }
    if (std::ranges::find(names, light) == names.end()) {
        throw InputError(fmt::format("{}: no light {}; there are {}", source,
                                     toml_excerpt({std::string{light}}), fmt::join(names, ", ")));
    }
}

namespace {

/// "Key Light.001" as "key-light-001"; "light" where nothing is left.
std::string light_name(std::string_view node)
{
    std::string name;
    for (const char c : node) {
        const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        const bool is_kept = is_light_name({&small, 1});
        if (is_kept || (!name.empty() && name.back() != '-')) {
            name += is_kept ? small : '-';
        }
    }
    constexpr std::size_t room_for_numbers = 4;
    name.resize(std::min(name.size(), longest_light_name - room_for_numbers));
    while (name.ends_with('-')) {
        name.pop_back();
    }
    return name.empty() ? "light" : name;
}

std::string unused_name(const std::string& name, const std::set<std::string>& used)
{
    std::string unused = name;
    for (int number = 2; used.contains(unused); ++number) {
        unused = fmt::format("{}-{}", name, number);
    }
    return unused;
}

/// The keys of [light] that describe this light.
Layer layer_of(const KeyTable& keys, const FileLight& light, const std::string& name,
               const std::string& source)
{
    Job job;
    job.light = light.settings;
    Layer layer;
    for (const Key& spec : keys.rows()) {
        if (auto value = spec.get(job); value && spec.name.starts_with("light.")) {
            std::string label =
                fmt::format("{}: {} = {}", source, WrittenKey{&spec, name}.text(), to_toml(*value));
            layer.push_back({&spec, std::move(*value), std::move(label), name});
        }
    }
    return layer;
}

} // namespace

LightTables light_tables_of(const KeyTable& keys, const std::vector<FileLight>& lights,
                            const std::string& source)
{
    if (lights.empty()) {
        throw InputError(
            fmt::format("{}: scene.lights = \"all\": the file has no light that can have a shadow "
                        "map; remove the key, or give lights under [[lights]]",
                        source));
    }
    if (lights.size() > most_lights) {
        throw InputError(fmt::format("{}: scene.lights = \"all\": the file has {} lights; at most "
                                     "{} are supported: give some under [[lights]]",
                                     source, lights.size(), most_lights));
    }
    LightTables tables;
    std::set<std::string> used;
    for (const FileLight& light : lights) {
        std::string name = unused_name(light_name(light.name), used);
        used.insert(name);
        Layer layer = layer_of(keys, light, name, source);
        std::ranges::move(layer, std::back_inserter(tables.layer));
        tables.names.push_back(std::move(name));
    }
    return tables;
}

LightTables read_file_lights(const KeyTable& keys, const std::filesystem::path& file,
                             const FileSpace& space)
{
    return light_tables_of(keys, load_scene_file(file, {}, VertexNormals::dropped, space).lights,
                           one_line(file.string()));
}

} // namespace gnomon::scene
