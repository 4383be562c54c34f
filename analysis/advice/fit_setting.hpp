#pragma once

#include "scene/settings/job.hpp"

#include <string>

namespace gnomon::analysis {

/// A fit in place of a job's own, as its file writes it: `fit = "scene"`. In place of a fixed one
/// with a comment that the keys of a fixed map must go, for the file is refused with both.
[[nodiscard]] std::string fit_setting(scene::Fit own, scene::Fit fit);

} // namespace gnomon::analysis
