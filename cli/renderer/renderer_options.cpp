#include "cli/renderer/renderer_options.hpp"

#include "scene/error.hpp"
#include "scene/job/renderer_choice.hpp"
#include "store/shell_text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <vector>

namespace gnomon::cli {

void add_renderer_timeout(CLI::App& command, RendererOptions& options)
{
    command
        .add_option("--renderer-timeout-s", options.longest_s,
                    "How long the renderer may take for each answer [s]")
        ->check(CLI::Range(0.01, 86400.0))
        ->capture_default_str();
}

void add_renderer_options(CLI::App& command, RendererOptions& options)
{
    command.add_option(
        "--renderer", options.name,
        "Let an installed renderer draw in GL's place; `gnomon renderers` lists them "
        "(docs/renderer_protocol.md)");
    command.add_option(
        "--renderer-command", options.command,
        "Let a program that speaks the protocol draw: the program and its arguments");
    add_renderer_timeout(command, options);
}

std::optional<RendererCommand> chosen_renderer(const RendererOptions& options,
                                               const JobOptions& job)
{
    if (options.name || options.command) {
        return renderer_command(options);
    }
    const std::string name = job.job_path.empty() || !job.builtin.empty()
                                 ? std::string{}
                                 : scene::renderer_of_job(job.job_path);
    return name.empty() ? std::nullopt : std::optional{installed_command(name)};
}

std::string renderer_text(const RendererOptions& options)
{
    std::vector<std::string> words;
    if (options.name) {
        words = {"--renderer", *options.name};
    } else if (options.command) {
        words = {"--renderer-command", *options.command};
    }
    return words.empty() ? std::string{} : fmt::format(" {}", store::shell_text(words));
}

RendererCommand renderer_command(const RendererOptions& options)
{
    if (options.name.has_value() == options.command.has_value()) {
        throw scene::InputError(
            !options.name
                ? "no renderer: give its NAME (`gnomon renderers` lists what is installed), or "
                  "--command \"PROGRAM ARGUMENTS\""
                : "an installed renderer's name and a command are mutually exclusive");
    }
    return options.name ? installed_command(*options.name) : given_command(*options.command);
}

} // namespace gnomon::cli
