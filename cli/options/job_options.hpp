#pragma once

#include "cli/options/job_options.hpp"
#include "methods/key_table.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace gnomon::api {
struct SessionOptions;
}

namespace gnomon::cli {

/// The options that name a job: JOB or --builtin NAME, --preset NAME, --set KEY=VALUE, --case NAME,
/// --light NAME.
struct JobOptions {
    std::string job_path;
    std::string builtin;
    std::string preset;
    std::vector<std::string> settings;
    std::string case_name;
    std::optional<std::string> light; ///< reduces a job with several lights to this one
    scene::Keys keys = methods::key_table();
};

void add_job_options(CLI::App& command, JobOptions& options);

/// @throws scene::InputError  if both JOB and --builtin are given, or neither and no preset; if a
///                            --set is not KEY=VALUE; or as `scene::read_job`.
[[nodiscard]] scene::JobFile read_job(const JobOptions& options);
/// The layers of the job before they are merged; ignores --case.
/// @throws scene::InputError  as `read_job`, and for a job file that names another renderer.
[[nodiscard]] scene::JobSource read_job_source(const JobOptions& options);
/// As `read_job_source`, for GL or another renderer.
[[nodiscard]] scene::JobSource read_any_job_source(const JobOptions& options);
/// As `read_any_job_source`, with the job file's text given.
[[nodiscard]] scene::JobSource job_source_of_text(const JobOptions& options,
                                                  const std::string& text);
/// @throws scene::InputError  if the job file names another renderer.
void require_job_of_gl(const JobOptions& options);
/// The values of --axis. With --light, an axis may also have the name it has among all lights.
[[nodiscard]] std::vector<std::string> axis_arguments(std::vector<std::string> axes,
                                                      const JobOptions& options);
/// The options with a light of the job chosen; an empty name changes nothing.
[[nodiscard]] JobOptions of_light(const JobOptions& options, const std::string& light);

/// The job as a run stores it: the file's text, or lines that stand for a preset or a scene.
[[nodiscard]] std::string job_text(const JobOptions& options);

/// The command that computes a run, without --out, quoted for a shell.
/// @param axes  the values of --axis.
[[nodiscard]] std::string command_text(std::string_view command, const JobOptions& options,
                                       const std::vector<std::string>& axes = {});

/// Adds --device and --threads.
void add_session_options(CLI::App& command, api::SessionOptions& options);

} // namespace gnomon::cli
