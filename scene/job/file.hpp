#pragma once

#include "scene/job/job.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

struct JobSource;

/// A stage of the computation. A key names the stages whose result changes with it, so that a sweep
/// knows what it can keep.
enum class Stage : std::uint8_t {
    scene = 1 << 0,      ///< triangles
    truth = 1 << 1,      ///< classes
    receivers = 1 << 2,  ///< camera pass; with lookup.position = "vertex" light clip coordinates
    shadow_map = 1 << 3, ///< the map
    prefilter = 1 << 4,  ///< what a method makes of the map before it is looked up
    lookup = 1 << 5,     ///< r, d
    bias = 1 << 6,       ///< verdicts only: answered by the bias curve
};
using Stages = std::uint8_t;

/// One key of the job file.
struct JobKey {
    std::string name;         ///< "shadow_map.resolution"
    std::string description;  ///< one line, with unit
    std::string unit;         ///< "m", "depth units"; empty: none
    std::string default_text; ///< as written in TOML, e.g. "1024" or "\"d24\""
    std::string range_text;   ///< e.g. "an integer from 1 to 16384"
    Stages stages = 0;        ///< the first stages that must be redone when it changes
};

/// Every key of the job file but `[sweep]` and `[[case]]`, in the order of docs/job_file.md.
[[nodiscard]] const std::vector<JobKey>& job_keys();

/// A key with a value in TOML syntax; a bare word is a string.
struct Override {
    std::string key;
    std::string value;
};

/// One axis of `[sweep]`, expanded to values in TOML syntax.
struct SweepAxis {
    std::string key;
    std::vector<std::string> values;
};

struct Sweep {
    std::vector<SweepAxis> axes;
    std::string mode = "product"; ///< product | zip
    std::int64_t sample = 0;      ///< 0: all
    std::int64_t seed = 0;
};

struct Case {
    std::string name;
    std::vector<Override> overrides;
};

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
                               std::string_view case_name = {});
[[nodiscard]] JobFile job_of(const JobSource& source, std::string_view case_name = {});
/// The job of each light, in the order of the lights.
/// @throws InputError  as `read_job`.
[[nodiscard]] std::vector<LightJob> light_jobs(const JobSource& source,
                                               std::string_view case_name = {});
[[nodiscard]] JobFile builtin_job(std::string_view name,
                                  const std::vector<Override>& overrides = {});

/// The job with every key written out, as (key, TOML value), in the order of `job_keys()`; keys of
/// a camera or light that the job leaves to the scene are absent. The columns of a result table.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> resolved_keys(const Job& job);

/// A commented job file with every key at its default: what `gnomon init` writes.
/// @param preset  whose values it has in place of the defaults, with its own scene or a built-in of
///                its light; empty: none.
/// @throws InputError  if there is no preset of that name.
[[nodiscard]] std::string commented_job_file(std::string_view preset = {});

/// The candidate that needs the fewest edits to become `word`, of several the first; empty without
/// candidates.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& candidates);
/// The same, but empty if more than half of the longer word's letters are edited: too far off to be
/// meant.
[[nodiscard]] std::string similar_word(std::string_view word,
                                       const std::vector<std::string>& candidates);

} // namespace gnomon::scene
