#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/tune/method_tune.hpp"
#include "api/comparison_session.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::api {

/// In which views advice must hold beside the job's own (docs/tune.md#views).
struct ViewOptions {
    int cameras = 0; ///< generated around the job's own, 0 to 64
    int lights = 0;  ///< the same
    bool all_cases = false;

    [[nodiscard]] bool any() const { return cameras > 0 || lights > 0 || all_cases; }
};

/// @param light  the one of several that the advice is for; empty: the job has but one.
/// @throws scene::InputError  if all cases are asked for and the job has none, or a case changes
///                            more than camera, light and image.
[[nodiscard]] analysis::ViewRequest
view_request(const ViewOptions& options, const scene::JobSource& source, std::string_view light);

/// Which methods are meant.
/// @param names  of the list, or "all" alone; each counts once.
/// @throws scene::InputError  naming an unknown method, with the nearest name.
[[nodiscard]] analysis::MethodRequest method_request(std::span<const std::string> names,
                                                     std::optional<std::uint64_t> max_bytes);

/// @throws scene::InputError  if a light's method has no map to draw or look up otherwise.
void require_advisable(std::span<const scene::LightJob> jobs);

/// Runs GL again with the changes that suit a comparison's errors, and adds to it what they give.
/// One without scored pixels has nothing to be mended.
/// @param methods  whose settings are tried, too.
/// @throws scene::InputError  as `analysis::judge_views` and `analysis::advise_methods`.
void advise(analysis::Comparison& comparison, const ComparisonSession& session,
            const analysis::ViewRequest& views,
            const std::optional<analysis::MethodRequest>& methods = {},
            const analysis::MethodProgress& progress = {});

} // namespace gnomon::api
