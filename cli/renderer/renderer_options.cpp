#include "cli/renderer/renderer_options.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <system_error>

namespace gnomon::cli {

void add_renderer_timeout(CLI::App& command, RendererOptions& options)
{
    command
        .add_option("--renderer-timeout-s", options.longest_s,
                    "How long the renderer may take for each answer [s]")
        ->check(CLI::Range(0.01, 86400.0))
        ->capture_default_str();
}

RendererCommand renderer_command(const RendererOptions& options)
{
    if (options.name.empty() == options.command.empty()) {
        throw scene::InputError(
            options.name.empty()
                ? "no renderer: give its NAME (`gnomon renderers` lists what is installed), or "
                  "--command \"PROGRAM ARGUMENTS\""
                : "an installed renderer's name and a command exclude each other: give one");
    }
    return options.name.empty() ? given_command(options.command) : installed_command(options.name);
}

std::filesystem::path temporary_folder()
{
    std::error_code error;
    auto folder = std::filesystem::temp_directory_path(error);
    if (error) {
        throw scene::EnvironmentError(
            fmt::format("TMPDIR: {}; set it to a folder that can be written", error.message()));
    }
    return folder;
}

} // namespace gnomon::cli
