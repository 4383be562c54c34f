#pragma once

#include "scene/case/file.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::scene {

/// Reads CASE: a folder with case.toml, or that file.
/// @param from  an exporter whose conventions hold where the file says nothing else; empty: none.
/// @throws InputError  "file:line: …", for unknown keys (naming the nearest), values out of range,
///                     what is missing, and keys that do not go together.
[[nodiscard]] CaseFile read_case_file(const std::filesystem::path& path, std::string_view from = {},
                                      Keys keys = own_keys());

/// A message about a job's keys as the case says it that gave them: "case.toml: mesh.no_cast: …"
/// for "scene.no_cast: …". Other messages are returned as they are.
[[nodiscard]] std::string case_message(const CaseFile& file, std::string_view message);

} // namespace gnomon::scene
