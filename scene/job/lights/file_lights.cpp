#include "scene/job/lights/file_lights.hpp"

#include "scene/error.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace gnomon::scene {

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

/// The keys of [light] that say it.
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
        throw InputError(fmt::format("{}: scene.lights = \"all\": the file brings no light that a "
                                     "shadow map may be of; remove the key, or give lights under "
                                     "[[lights]]",
                                     source));
    }
    if (lights.size() > most_lights) {
        throw InputError(fmt::format("{}: scene.lights = \"all\": the file brings {} lights; at "
                                     "most {} are possible: give some under [[lights]]",
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
