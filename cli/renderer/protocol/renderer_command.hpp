#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::cli {

/// How a renderer is started.
struct RendererCommand {
    std::vector<std::string> words; ///< the program and its arguments
    std::string name;               ///< in messages, until the renderer gives its own
    std::vector<std::string> check; ///< a program that prints what is missing; may be empty
    /// Its league.toml, with the values that its documentation recommends; may be empty.
    std::filesystem::path description = {};
};

/// Runs a renderer's check for missing parts.
/// @param check  the program, found in PATH, and its arguments; not empty.
/// @return  One line that says what is missing, or how the check failed; empty if nothing is.
/// @throws scene::EnvironmentError  if there are no processes or pipes.
[[nodiscard]] std::string missing_part(const std::vector<std::string>& check);

/// Possible reasons why a renderer ended before its first answer: what its check finds missing, and
/// arguments that look like files but do not exist.
/// @return  Sentences, each after "; "; may be empty.
/// @throws scene::EnvironmentError  as `missing_part`.
[[nodiscard]] std::string start_problems(const RendererCommand& command);

/// A folder of engines/ with a renderer.toml.
struct InstalledRenderer {
    std::string name; ///< of the folder
    std::filesystem::path folder;
    std::string title;
    std::vector<std::string> command; ///< names of files in the folder are replaced by their paths
    std::vector<std::string> needs;   ///< what must be installed, each a sentence
    std::vector<std::string> check;   ///< as `RendererCommand::check`
};

/// The renderers installed with this Gnomon, or in its checkout, sorted by name.
/// @throws scene::InputError  naming a renderer.toml that is not valid.
[[nodiscard]] std::vector<InstalledRenderer> installed_renderers();

/// @throws scene::InputError  if it is not installed; names the nearest one that is.
[[nodiscard]] RendererCommand installed_command(const std::string& name);

/// Splits a command into words as a shell does: at blanks that are neither quoted nor escaped by a
/// backslash; nothing else is special. Names of files become absolute paths, because the renderer
/// starts in another folder.
/// @throws scene::InputError  if it is empty, or a quote is not closed.
[[nodiscard]] RendererCommand given_command(const std::string& text);

} // namespace gnomon::cli
