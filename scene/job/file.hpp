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

/// A job with one of several lights alone.
struct LightJob {
    std::string light; ///< its name; empty: the job has but one
    Job job;
};

struct JobFile {
    Job job; ///< defaults, then the built-in's own, then the file's keys, then the overrides
    Sweep sweep;
    std::vector<Case> cases;
};

/// Reads a job from a .toml file, from a scene file (a job of defaults) or from a built-in's name.
///
/// Unknown keys name the nearest known one; every value is range-checked.
/// @param case_name  empty, or the `[[case]]` whose keys are laid over the file's.
/// @throws InputError  "file:line: key = value: what is allowed"; also for a job with several
///                     lights, which is several jobs (`light_jobs`).
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

/// A commented job file with every key at its default: what `gnomon init` writes.
/// @param preset  whose values it has in place of the defaults, with its own scene or a built-in of
///                its light; empty: none.
/// @throws InputError  if there is no preset of that name.
[[nodiscard]] std::string commented_job_file(std::string_view preset = {},
                                             const Keys& keys = own_keys());

} // namespace gnomon::scene
