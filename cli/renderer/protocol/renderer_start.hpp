#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::cli {

/// How a renderer is started.
struct RendererCommand {
    std::vector<std::string> words; ///< the program and its arguments
    std::string name;               ///< how messages speak of it until it says its own
    std::vector<std::string> check; ///< a program that says what is missing; empty: there is none
    /// A league.toml, which says what its documentation recommends; empty: nothing is known.
    std::filesystem::path description = {};
};

/// What an installed renderer lacks, as its own check says in one line.
/// @param check  the program, found in PATH, and its arguments; not empty.
/// @return  Empty: it lacks nothing. A check that fails is what is said.
/// @throws scene::EnvironmentError  if there are no processes or pipes.
[[nodiscard]] std::string missing_part(const std::vector<std::string>& check);

/// Why a renderer that ended before it said who it is may have: what its check finds missing, and
/// arguments that look like files where there are none.
/// @return  Sentences, each after "; "; empty: nothing is known.
/// @throws scene::EnvironmentError  as `missing_part`.
[[nodiscard]] std::string start_problems(const RendererCommand& command);

} // namespace gnomon::cli
