#pragma once

#include "scene/job/setting_layers.hpp"
#include "scene/job/toml.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Each light has its maps and results: beyond this a job is a mistake.
inline constexpr std::size_t most_lights = 64;

/// What a job file's `[[lights]]` say: the lights' names, in their order, and their keys.
struct LightTables {
    std::vector<std::string> names;
    Layer layer;
};

/// @throws InputError  naming the file and the line, for a light without a name or with that of
///                     another, for too many of them, and as `layer_from_table`.
[[nodiscard]] LightTables read_light_tables(const KeyTable& keys, const TomlMember& member,
                                            const std::string& file);

/// Refuses settings of lights that the job does not have, and where it has several what would place
/// them all alike.
/// @throws InputError  naming the setting.
void check_lights(const std::vector<std::string>& names, const Layer& layer);

/// The name, if the job has such a light.
/// @throws InputError  naming the lights that there are.
void require_light(const std::vector<std::string>& names, std::string_view light,
                   std::string_view source);

} // namespace gnomon::scene
