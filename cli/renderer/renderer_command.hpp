#pragma once

#include "cli/renderer/protocol/renderer_client.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::cli {

/// A folder of engines/ with a renderer.toml.
struct InstalledRenderer {
    std::string name; ///< the folder's
    std::filesystem::path folder;
    std::string title;
    std::vector<std::string> command; ///< words that name files of the folder are their paths
    std::vector<std::string> needs;   ///< what must be installed for it, each a sentence
    std::vector<std::string> check;   ///< as `RendererCommand::check`
};

/// What is installed with this Gnomon, or lies in its checkout, by name.
/// @throws scene::InputError  naming the renderer.toml that is not as it should be.
[[nodiscard]] std::vector<InstalledRenderer> installed_renderers();

/// @throws scene::InputError  naming the nearest installed renderer.
[[nodiscard]] RendererCommand installed_command(const std::string& name);

/// A command as a shell would split it into words: at blanks that are neither in quotes nor after a
/// backslash; nothing else is special. Words that name files are made absolute paths, as the
/// renderer is started in a folder of its own.
/// @throws scene::InputError  if it is empty, or a quote is not closed.
[[nodiscard]] RendererCommand given_command(const std::string& text);

} // namespace gnomon::cli
