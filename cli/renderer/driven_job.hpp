#pragma once

#include "cli/options/job_options.hpp"
#include "cli/renderer/renderer_options.hpp"
#include "cli/renderer/renderer_session.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::cli {

/// How a renderer is started for a command: its files are in the folder for temporary ones, whose
/// path is short. Browsers make sockets in theirs, and a socket's path has at most 107 bytes.
[[nodiscard]] RendererSettings renderer_settings(RendererCommand command,
                                                 const RendererOptions& options, int threads);

/// Reads the job that a renderer is to draw, with the keys that it has of its own.
/// @throws scene::InputError  as `read_any_job_source`, and for a job with several lights.
[[nodiscard]] scene::JobSource read_driven_job(const RendererSession& session,
                                               const JobOptions& options);

/// The job alone, as a space of one configuration, without its sweep and the cases that are not
/// named.
/// @throws scene::InputError  as `scene::SweepSpace`.
[[nodiscard]] scene::SweepSpace space_of_one(scene::JobSource source, const std::string& case_name);

/// Refuses options that ask something of GL.
/// @param options  their names, and whether they are given.
/// @throws scene::InputError  naming the first that is.
void refuse_for_renderer(std::initializer_list<std::pair<std::string_view, bool>> options);

/// The keys of pairs of keys and values.
[[nodiscard]] std::vector<std::string>
key_names(const std::vector<std::pair<std::string, std::string>>& keys);

} // namespace gnomon::cli
