#include "scene/job/keys/written_key.hpp"

#include "scene/job/keys/key_table.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace gnomon::scene {

namespace {

constexpr std::string_view lights_table = "lights";
constexpr std::string_view light_table = "light";
constexpr std::array<std::string_view, 5> tables_of_light{light_table, "shadow_map", "lookup",
                                                          "bias", "method"};

/// The parts of "lights.sun.bias.slope".
struct Parts {
    std::string_view light;
    std::string_view rest; ///< "bias.slope"; empty: only the light is named
};

std::optional<Parts> parts_of(std::string_view name)
{
    if (!name.starts_with(lights_table) || name.size() <= lights_table.size() ||
        name[lights_table.size()] != '.') {
        return std::nullopt;
    }
    name.remove_prefix(lights_table.size() + 1);
    const std::size_t dot = name.find('.');
    return dot == std::string_view::npos ? Parts{name, {}}
                                         : Parts{name.substr(0, dot), name.substr(dot + 1)};
}

/// A known key's name within the keys of one light.
std::string_view name_in_light(std::string_view key)
{
    const std::size_t dot = key.find('.');
    return key.substr(0, dot) == light_table ? key.substr(dot + 1) : key;
}

} // namespace

std::string WrittenKey::text() const
{
    return light.empty() ? spec->name
                         : fmt::format("{}.{}.{}", lights_table, light, name_in_light(spec->name));
}

bool is_key_of_light(std::string_view key)
{
    return std::ranges::find(tables_of_light, key.substr(0, key.find('.'))) !=
           tables_of_light.end();
}

WrittenKey find_written_key(const KeyTable& keys, std::string_view name)
{
    const auto parts = parts_of(name);
    if (!parts) {
        return {keys.find(name), {}};
    }
    const Key* spec = keys.find(fmt::format("{}.{}", light_table, parts->rest));
    spec = spec != nullptr ? spec : keys.find(parts->rest);
    const bool is_known = spec != nullptr && is_light_name(parts->light) &&
                          is_key_of_light(spec->name) && name_in_light(spec->name) == parts->rest;
    return is_known ? WrittenKey{spec, std::string{parts->light}} : WrittenKey{};
}

bool is_written_table(const KeyTable& keys, std::string_view name)
{
    const auto parts = parts_of(name);
    if (!parts) {
        return name == lights_table || keys.has_table(name);
    }
    return parts->rest.empty() || keys.has_table(fmt::format("{}.{}", light_table, parts->rest)) ||
           (parts->rest != light_table && is_key_of_light(parts->rest) &&
            keys.has_table(parts->rest));
}

std::string nearest_written_key(const KeyTable& keys, std::string_view name,
                                std::vector<std::string> candidates)
{
    const auto parts = parts_of(name);
    const std::string_view light = parts ? parts->light : std::string_view{};
    for (const Key& spec : keys.rows()) {
        if (!light.empty() && !is_key_of_light(spec.name)) {
            continue;
        }
        std::string written = WrittenKey{&spec, std::string{light}}.text();
        if (key_leaf(spec.name) == key_leaf(name)) {
            return written;
        }
        candidates.push_back(std::move(written));
    }
    return nearest_word(name, candidates);
}

bool is_preset_key(std::string_view name)
{
    return key_leaf(name) == "preset";
}

bool is_light_name(std::string_view text)
{
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789_-";
    return !text.empty() && text.size() <= longest_light_name &&
           text.find_first_not_of(letters) == std::string_view::npos;
}

} // namespace gnomon::scene
