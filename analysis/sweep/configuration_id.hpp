#pragma once

#include "analysis/sweep/scene_identity.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// Keys and their values as the job file writes them.
using JobParameters = std::vector<std::pair<std::string, std::string>>;

/// What stands for a scene in ids: its identity; where that is not known, its file as the job
/// writes it.
[[nodiscard]] std::string scene_in_ids(const SceneIdentity& scene, const JobParameters& given);

/// The id of a configuration: 16 hexadecimal digits, a hash of everything that its results depend
/// on.
/// @param version             Gnomon's.
/// @param scene_name          `scene_in_ids`.
/// @param with_constant_bias  Without it the id is that of its bias curve.
[[nodiscard]] std::string configuration_id(std::string_view version, std::string_view scene_name,
                                           const JobParameters& parameters,
                                           bool with_constant_bias);

} // namespace gnomon::analysis
