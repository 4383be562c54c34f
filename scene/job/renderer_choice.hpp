#pragma once

#include "scene/job/toml.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::scene {

/// Whether the file name is that of a scene (.gltf, .glb, .obj, .ply), not of a job.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& path);

/// The key of a job file that names another renderer to use instead of GL.
inline constexpr std::string_view renderer_key = "renderer";

/// The installed renderer that a job file names with `renderer = "NAME"`, found before the job is
/// read. Empty if it names none or is not a job file. Does not look at pipes, which can be read
/// only once.
/// @throws InputError  if the file cannot be read or is not TOML, or as `read_renderer_choice`.
[[nodiscard]] std::string renderer_of_job(const std::filesystem::path& path);

/// The name in `renderer = "NAME"`.
/// @param source  the file, for messages.
/// @throws InputError  if it is not a name. Commands are refused, because job files come from
///                     strangers.
[[nodiscard]] std::string read_renderer_choice(const TomlMember& member, const std::string& source);

/// Refuses keys that look like a renderer command: "renderer_command", "renderer-command", …
/// @throws InputError
void refuse_renderer_command(const TomlMember& member, const std::string& source);

} // namespace gnomon::scene
