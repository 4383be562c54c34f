#pragma once

#include "scene/job/toml.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::scene {

/// The key of a job file that names another renderer, which draws in GL's place.
inline constexpr std::string_view renderer_key = "renderer";

/// The installed renderer that a job file names by `renderer = "NAME"`, before anything else of it
/// is read; empty: it names none, or is no job file. Of a pipe, which can be read but once, nothing
/// is looked at.
/// @throws InputError  if the file cannot be read or is no TOML, or as `read_renderer_choice`.
[[nodiscard]] std::string renderer_of_job(const std::filesystem::path& path);

/// The name in `renderer = "NAME"`.
/// @param source  the file, for messages.
/// @throws InputError  if it is no name: whatever may be a command is refused, for job files come
///                     from strangers.
[[nodiscard]] std::string read_renderer_choice(const TomlMember& member, const std::string& source);

/// Refuses what looks like a command for a renderer: "renderer_command", "renderer-command", …
/// @throws InputError
void refuse_renderer_command(const TomlMember& member, const std::string& source);

} // namespace gnomon::scene
