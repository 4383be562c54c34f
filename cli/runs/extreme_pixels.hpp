#pragma once

#include "api/scene_session.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// Keeps in RUN the layers of those configurations that people look at first: the one with the
/// fewest errors, the one with the most, and the job's own where the sweep has it. Those that are
/// kept already are not computed again; stops early when interrupted.
/// @param source  the space's.
/// @return  "the best", "the worst", "the job's own": those whose layers are kept.
/// @throws scene::InputError, scene::EnvironmentError  as a comparison does.
std::vector<std::string> keep_extreme_pixels(const std::filesystem::path& folder,
                                             const scene::SweepSpace& space,
                                             scene::JobSource source, std::string_view case_name,
                                             const api::SessionOptions& options);

} // namespace gnomon::cli
