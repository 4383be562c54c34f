#pragma once

#include "scene/job/setting_layers.hpp"
#include "scene/job/toml.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Each light has its own maps and results; more lights are probably a mistake.
inline constexpr std::size_t most_lights = 64;

/// A job file's `[[lights]]`: the lights' names, in order, and their keys.
struct LightTables {
    std::vector<std::string> names;
    Layer layer;
};

/// @throws InputError  naming file and line, if a light has no name or a repeated one, if there are
///                     too many, and as `layer_from_table`.
[[nodiscard]] LightTables read_light_tables(const KeyTable& keys, const TomlMember& member,
                                            const std::string& file);

/// Refuses settings for lights that the job does not have and, if it has several lights, settings
/// that would place all of them alike.
/// @throws InputError  naming the setting.
void check_lights(const std::vector<std::string>& names, const Layer& layer);

/// Checks that the job has a light of this name.
/// @throws InputError  naming the job's lights.
void require_light(const std::vector<std::string>& names, std::string_view light,
                   std::string_view source);

struct FileLight;
struct FileSpace;

/// Converts a scene file's lights to `[[lights]]`. Their names are those of their nodes, in lower
/// case, with hyphens for invalid characters and numbers for repetitions: "lamp", "lamp-2".
/// @param source  The file, for messages.
/// @throws InputError  if the file has no light, or too many.
[[nodiscard]] LightTables light_tables_of(const KeyTable& keys,
                                          const std::vector<FileLight>& lights,
                                          const std::string& source);

/// Reads a scene file and converts its lights.
/// @param space  of the scene file.
/// @throws InputError  also as `load_scene_file`.
[[nodiscard]] LightTables read_file_lights(const KeyTable& keys, const std::filesystem::path& file,
                                           const FileSpace& space);

} // namespace gnomon::scene
