#pragma once

#include "scene/job/keys/key_table.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

struct JobSource;

/// A job with only one of several lights.
struct LightJob {
    std::string light; ///< its name; empty: the job has only one light
    Job job;
};

struct JobFile {
    Job job; ///< defaults, then the built-in's own, then the file's keys, then the overrides
    Sweep sweep;
    std::vector<Case> cases;
};

/// Reads a job from a .toml file or a scene file (a default job).
///
/// Errors about unknown keys name the nearest known key. Every value is range-checked.
/// @param case_name  empty, or the `[[case]]` whose keys are laid over the file's.
/// @throws InputError  "file:line: key = value: what is allowed"; also for a job with several
///                     lights; use `light_jobs` for those.
[[nodiscard]] JobFile read_job(const std::filesystem::path& path,
                               const std::vector<Override>& overrides = {},
                               std::string_view case_name = {}, const Keys& keys = own_keys());
[[nodiscard]] JobFile job_of(const JobSource& source, std::string_view case_name = {});
/// The job of each light, in the order of the lights.
/// @throws InputError  as `read_job`.
[[nodiscard]] std::vector<LightJob> light_jobs(const JobSource& source,
                                               std::string_view case_name = {});
[[nodiscard]] JobFile builtin_job(std::string_view name,
                                  const std::vector<Override>& overrides = {},
                                  const Keys& keys = own_keys());

/// The commented job file with all defaults that `gnomon init` writes.
/// @param preset  supplies the values instead of the defaults, with its own scene or a built-in for
///                its light; may be empty.
/// @throws InputError  if no preset has that name.
[[nodiscard]] std::string commented_job_file(std::string_view preset = {},
                                             const Keys& keys = own_keys());

/// The names of the stages in results and documents, in order: "shadow_map".
[[nodiscard]] std::vector<std::string_view> stage_names(Stages stages);

} // namespace gnomon::scene
