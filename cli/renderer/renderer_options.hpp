#pragma once

#include "cli/renderer/renderer_command.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace gnomon::cli {

/// The options that name another renderer: --renderer NAME or --renderer-command "…", and how long
/// it may take to answer.
struct RendererOptions {
    std::string name;
    std::string command;
    double longest_s = 60;

    [[nodiscard]] RendererClient::Seconds longest() const
    {
        return RendererClient::Seconds{longest_s};
    }
};

/// Adds --renderer-timeout-s.
void add_renderer_timeout(CLI::App& command, RendererOptions& options);

/// @throws scene::InputError  if neither or both are given, or as `installed_command` and
///                            `given_command` do.
[[nodiscard]] RendererCommand renderer_command(const RendererOptions& options);

/// Where temporary folders are made: TMPDIR, or /tmp.
[[nodiscard]] std::filesystem::path temporary_folder();

} // namespace gnomon::cli
