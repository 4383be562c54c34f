#pragma once

#include "cli/options/job_options.hpp"
#include "cli/renderer/renderer_command.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// The options that name another renderer: --renderer NAME or --renderer-command "…", and how long
/// it may take to answer.
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
/// Adds it, --renderer and --renderer-command.
void add_renderer_options(CLI::App& command, RendererOptions& options);

/// What draws in GL's place: what the options name, or else the job file; empty: GL itself.
/// @throws scene::InputError  if both options are given, as `installed_command` and
///                            `given_command`, or as `scene::renderer_of_job`.
[[nodiscard]] std::optional<RendererCommand> chosen_renderer(const RendererOptions& options,
                                                             const JobOptions& job);

/// The options as they were given, quoted for a shell, each after a blank.
[[nodiscard]] std::string renderer_text(const RendererOptions& options);

/// @throws scene::InputError  if neither or both are given, or as `installed_command` and
///                            `given_command` do.
[[nodiscard]] RendererCommand renderer_command(const RendererOptions& options);

/// Where temporary folders are made: TMPDIR, or /tmp.
[[nodiscard]] std::filesystem::path temporary_folder();

} // namespace gnomon::cli
