#pragma once

#include "scene/job/file.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::cli {

/// A configuration of a run, as a job.
struct RunJob {
    std::string configuration; ///< its ID
    std::string case_name;     ///< empty without cases
    std::string settings;      ///< what it sets among the run's; empty for the only one
    scene::LightJob job;
};

/// The jobs of a run's best configurations, as its report ranks them: the lowest error rate, ties
/// by the smallest map. Cases and lights are not comparable, so each has its own.
/// @param folder         of `gnomon sweep --out` or `compare --out`.
/// @param configuration  ID of the one to take instead; empty: the best.
/// @throws scene::InputError  if there is no run, nothing was measured, another renderer drew it,
/// or
///                            it has no such configuration.
[[nodiscard]] std::vector<RunJob> jobs_of_run(const std::filesystem::path& folder,
                                              const std::string& configuration);

} // namespace gnomon::cli
