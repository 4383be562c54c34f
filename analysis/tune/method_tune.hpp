#pragma once

#include "analysis/tune/method_space.hpp"
#include "analysis/tune/tune.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// The methods that a search tries.
struct MethodRequest {
    std::vector<std::string> methods; ///< names of known methods, each once; at least one
    /// For each method's maps; empty: as many as the job's own maps take.
    std::optional<std::uint64_t> max_bytes;
};

/// Callbacks for the progress of a search.
struct MethodProgress {
    /// Called before its first setting with the number of methods, and the most settings and bytes.
    std::function<void(std::size_t methods, std::size_t settings, std::uint64_t max_bytes)> begins;
    std::function<void(const TunedSetting&)> tried;
};

/// Whether a is less wrong than b within a memory budget. The first difference decides: limits met;
/// amount of error per scored pixel; bytes, then taps; errors by count; width of the valley.
[[nodiscard]] bool is_less_wrong(const TunedSetting& a, const TunedSetting& b);

/// The keys of the second job that differ from the first's, as "KEY = VALUE".
[[nodiscard]] std::vector<std::string> changed_keys(const scene::Job& from, const scene::Job& to);

/// Searches the settings of several methods, whose maps share one limit on bytes, for the least
/// wrong ones within the limits.
///
/// For each method the search goes twice along every axis (`MethodSpace`) and keeps improvements.
/// It checks settings in other views only if they meet the limits in the job's own, except for each
/// method's best. It passes over methods that cannot handle the job's light, layout or format.
/// @param file   The scene; must outlive the result, which points to its triangles.
/// @param views  The job's own first.
/// @return  With `methods`; recommends the least wrong of all.
/// @throws scene::InputError  if all are passed over, or the job's own method has no map and
///                            `max_bytes` is empty.
/// Source: docs/tune.md#methods.
[[nodiscard]] TuneResult tune_methods(const scene::Job& job, const scene::SceneFile& file,
                                      const Renderers& renderers, const CheckedViews& views,
                                      const TuneLimits& limits, const MethodRequest& request,
                                      const MethodProgress& progress);

/// Adds each method's least wrong setting over all views to a comparison's advice, and names the
/// methods that were passed over.
/// @param views  The job's own first.
/// @throws scene::InputError  As `tune_methods`.
void advise_methods(Comparison& comparison, const CheckedViews& views, const scene::SceneFile& file,
                    const Renderers& renderers, const MethodRequest& request,
                    const MethodProgress& progress);

} // namespace gnomon::analysis
