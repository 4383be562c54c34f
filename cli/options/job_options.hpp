#pragma once

#include "methods/key_table.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
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
    std::optional<std::string> light;        ///< the one of several that the job is reduced to
    scene::Keys keys = methods::key_table(); ///< the table it is read with
};

void add_job_options(CLI::App& command, JobOptions& options);

/// @throws scene::InputError  if both of JOB and --builtin are given, or neither and no preset; if
/// a
///                            --set is not KEY=VALUE, or as `scene::read_job` does.
[[nodiscard]] scene::JobFile read_job(const JobOptions& options);
/// What the options name, its parts not yet laid over each other; --case is not looked at.
/// @throws scene::InputError  as `read_job`, and for a job file that names another renderer.
[[nodiscard]] scene::JobSource read_job_source(const JobOptions& options);
/// The same of a job that GL or another renderer draws.
[[nodiscard]] scene::JobSource read_any_job_source(const JobOptions& options);
/// The same of options whose job file has that text, wherever it is now.
[[nodiscard]] scene::JobSource job_source_of_text(const JobOptions& options,
                                                  const std::string& text);
/// @throws scene::InputError  if the job file names another renderer.
void require_job_of_gl(const JobOptions& options);
/// The values of --axis; with --light an axis may be named as among all lights, too.
[[nodiscard]] std::vector<std::string> axis_arguments(std::vector<std::string> axes,
                                                      const JobOptions& options);
/// The options with a light chosen, by the name that it has in the job; empty: as they are.
[[nodiscard]] JobOptions of_light(const JobOptions& options, const std::string& light);

} // namespace gnomon::cli
