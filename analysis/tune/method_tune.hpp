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

/// Which methods a search tries.
struct MethodRequest {
    std::vector<std::string> methods;       ///< names of the list, each once; at least one
    std::optional<std::uint64_t> max_bytes; ///< of each one's maps; empty: what the job's own take
};

/// What is told of a search while it goes on.
struct MethodProgress {
    /// Before its first setting: how many methods, settings at most, and bytes at most.
    std::function<void(std::size_t methods, std::size_t settings, std::uint64_t max_bytes)> begins;
    std::function<void(const TunedSetting&)> tried;
};

/// Whether a is less wrong than b at as many bytes: it meets the limits; is less wrong by amount
/// per scored pixel; takes fewer bytes, then fewer taps; has fewer errors by count; a broader
/// valley.
[[nodiscard]] bool is_less_wrong(const TunedSetting& a, const TunedSetting& b);

/// The keys that differ, as a job file with the second job has them, "KEY = VALUE"; those that the
/// second lacks are left out.
[[nodiscard]] std::vector<std::string> changed_keys(const scene::Job& from, const scene::Job& to);

/// Searches the settings of several methods, each with maps of at most as many bytes, for the ones
/// that are least wrong within the limits.
///
/// Of each method the search goes along one axis after the other (`MethodSpace`), twice, and keeps
/// what is less wrong. A setting that does not meet the limits in the job's own view is not looked
/// at in the others, but for the best of each method. Methods that can do nothing with the job's
/// light, layout or format are passed over.
/// @param file   The scene; must outlive the result, which points to its triangles.
/// @param views  The job's own first.
/// @return  With `methods`; what is recommended is the least wrong of all.
/// @throws scene::InputError  if all are passed over, or the job's own method has no map and no
///                            `max_bytes` is given.
/// Source: docs/tune.md#methods.
[[nodiscard]] TuneResult tune_methods(const scene::Job& job, const scene::SceneFile& file,
                                      const Renderers& renderers, const CheckedViews& views,
                                      const TuneLimits& limits, const MethodRequest& request,
                                      const MethodProgress& progress);

} // namespace gnomon::analysis
