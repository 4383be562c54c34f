#pragma once

#include "scene/job/lights/light_tables.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::scene {

struct FileLight;
struct FileSpace;

/// What `[[lights]]` would say of a scene file's lights. They are named after their nodes, in small
/// letters, with a hyphen for whatever a name cannot hold, and numbered where names come again:
/// "lamp", "lamp-2".
/// @param source  The file, for messages.
/// @throws InputError  if there is none, or too many.
[[nodiscard]] LightTables light_tables_of(const KeyTable& keys,
                                          const std::vector<FileLight>& lights,
                                          const std::string& source);

/// The same of a file that is read for it.
/// @param space  of the scene's file.
/// @throws InputError  also as `load_scene_file`.
[[nodiscard]] LightTables read_file_lights(const KeyTable& keys, const std::filesystem::path& file,
                                           const FileSpace& space);

} // namespace gnomon::scene
