#pragma once

#include <filesystem>
#include <string>

namespace gnomon::cli {

/// What a sweep found: for each case and light the settings with the lowest and the highest error
/// rate, a line each, and the command that shows all of them. At most eight lines.
/// @param folder  RUN; with at least one measured configuration, else the answer is empty.
/// @throws scene::InputError, scene::EnvironmentError  as `store::RunReader`.
[[nodiscard]] std::string sweep_answer(const std::filesystem::path& folder, bool in_colour);

} // namespace gnomon::cli
