#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/tune/method_tune.hpp"
#include "api/compare.hpp"
#include "scene/job/file.hpp"
#include "scene/job/source.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::api {

/// Further views in which advice must hold, beside the job's own (docs/tune.md#views).
struct ViewOptions {
    int cameras = 0; ///< to generate around the job's, 0 to 64
    int lights = 0;  ///< to generate around the job's, 0 to 64
    bool all_cases = false;

    [[nodiscard]] bool any() const { return cameras > 0 || lights > 0 || all_cases; }
};

/// @param light  name of the light to advise on; empty if the job has only one.
/// @throws scene::InputError  if `all_cases` is set and the job has no case, or a case changes more
///                            than camera, light and image.
[[nodiscard]] analysis::ViewRequest
view_request(const ViewOptions& options, const scene::JobSource& source, std::string_view light);

/// The methods with these names.
/// @param names  method names, or "all" by itself; duplicates are ignored.
/// @throws scene::InputError  naming an unknown method and the nearest known name.
[[nodiscard]] analysis::MethodRequest method_request(std::span<const std::string> names,
                                                     std::optional<std::uint64_t> max_bytes);

/// @throws scene::InputError  if a light's method has no shadow map.
void require_advisable(std::span<const scene::LightJob> jobs);

/// Reruns GL with the changes that suit a comparison's errors, and adds the results to its advice.
/// Does nothing without scored pixels.
/// @param methods  further methods to try.
/// @throws scene::InputError  as `analysis::judge_views` and `analysis::advise_methods`.
void advise(analysis::Comparison& comparison, const ComparisonSession& session,
            const analysis::ViewRequest& views,
            const std::optional<analysis::MethodRequest>& methods = {},
            const analysis::MethodProgress& progress = {});

} // namespace gnomon::api
