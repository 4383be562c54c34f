#pragma once

#include "api/loaded_scene.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// Keeps in RUN the layers of the configurations with the fewest and the most errors, and of the
/// job's own if the sweep has it; of each of the first ten cases, if there are several. Skips those
/// that are kept already; stops early if interrupted.
/// @param source  of the space.
/// @return  which layers are kept: "the best", "the worst", "the job's own", or
/// "the best of each case" ….
/// @throws scene::InputError, scene::EnvironmentError  as a comparison does.
std::vector<std::string> keep_extreme_pixels(const std::filesystem::path& folder,
                                             const scene::SweepSpace& space,
                                             const scene::JobSource& source,
                                             std::string_view case_name,
                                             const api::SessionOptions& options);

} // namespace gnomon::cli
