#pragma once

#include "cli/options/job_options.hpp"
#include "cli/renderer/protocol/renderer_client.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// The options that choose another renderer: --renderer NAME or --renderer-command "…", and
/// --renderer-timeout-s.
struct RendererOptions {
    std::optional<std::string> name;
    std::optional<std::string> command;
    double longest_s = 60;

    [[nodiscard]] RendererClient::Seconds longest() const
    {
        return RendererClient::Seconds{longest_s};
    }
};

/// Adds --renderer-timeout-s.
void add_renderer_timeout(CLI::App& command, RendererOptions& options);
/// Adds --renderer-timeout-s, --renderer and --renderer-command.
void add_renderer_options(CLI::App& command, RendererOptions& options);

/// The renderer that the options or else the job file choose; empty for GL.
/// @throws scene::InputError  if both options are given, as `installed_command` and
///                            `given_command`, or as `scene::renderer_of_job`.
[[nodiscard]] std::optional<RendererCommand> chosen_renderer(const RendererOptions& options,
                                                             const JobOptions& job);

/// The given options, quoted for a shell, each after a blank.
[[nodiscard]] std::string renderer_text(const RendererOptions& options);

/// @throws scene::InputError  if neither or both are given, or as `installed_command` and
///                            `given_command` do.
[[nodiscard]] RendererCommand renderer_command(const RendererOptions& options);

} // namespace gnomon::cli
