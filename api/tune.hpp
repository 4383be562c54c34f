#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/tune/method_tune.hpp"
#include "analysis/tune/tuned_setting.hpp"
#include "api/compare.hpp"
#include "reports/tune/tuned_setting.hpp"
#include "scene/job/file.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::api {

/// The goal and the search space of `tune`.
struct TuneRequest {
    analysis::TuneGoal goal; ///< its clock is the first light's; other lights start new clocks
    std::optional<analysis::MethodRequest> methods = {};
};

/// Callbacks of a search; each may be empty. An exception from one ends the search.
struct TuneWatcher {
    std::function<void(const std::string& light, const analysis::TunedSetting&)> tried;
    /// The callbacks for a search over methods.
    std::function<analysis::MethodProgress(const std::string& light)> methods;
};

/// Searches, for each light of a job, the cheapest map that meets the goal's limits, or is as good
/// as the scene allows.
/// @param jobs   the session's jobs.
/// @param views  for each job.
/// @return  A result for each job. Results refer to the session's scene.
/// @throws scene::InputError  as `analysis::tune` and `analysis::tune_methods`.
[[nodiscard]] std::vector<reports::TunedLight> tune(const ComparisonSession& session,
                                                    std::span<const scene::LightJob> jobs,
                                                    std::span<const analysis::ViewRequest> views,
                                                    const TuneRequest& request,
                                                    const TuneWatcher& watcher = {});

/// @throws scene::InputError  if a light's method has no bias curve, which the search needs.
void require_tunable(std::span<const scene::LightJob> jobs);

} // namespace gnomon::api
