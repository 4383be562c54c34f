#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/tune/method_tune.hpp"
#include "analysis/tune/tune_goal.hpp"
#include "api/comparison_session.hpp"
#include "reports/text/tuned_setting.hpp"
#include "scene/job/file.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::api {

/// What `tune` searches for, and over what.
struct TuneRequest {
    analysis::TuneGoal goal; ///< its clock is the first light's; others start anew
    std::optional<analysis::MethodRequest> methods = {};
};

/// Callbacks of a search; each may be empty. An exception from one ends the search.
struct TuneWatcher {
    std::function<void(const std::string& light, const analysis::TunedSetting&)> tried;
    /// Of a search over methods.
    std::function<analysis::MethodProgress(const std::string& light)> methods;
};

/// Searches the cheapest map that is as good as the scene allows, or meets the goal's limits, for
/// each light of a job.
/// @param jobs   those that the session was made of.
/// @param views  of each.
/// @return  In their order. They refer to the session's scene.
/// @throws scene::InputError  as `analysis::tune` and `analysis::tune_methods` do.
[[nodiscard]] std::vector<reports::TunedLight> tune(const ComparisonSession& session,
                                                    std::span<const scene::LightJob> jobs,
                                                    std::span<const analysis::ViewRequest> views,
                                                    const TuneRequest& request,
                                                    const TuneWatcher& watcher = {});

/// @throws scene::InputError  if a light's method has no bias curve, which a search is made of.
void require_tunable(std::span<const scene::LightJob> jobs);

} // namespace gnomon::api
