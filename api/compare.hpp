#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/renderers.hpp"
#include "api/comparison_session.hpp"
#include "scene/image.hpp"
#include "scene/job/file.hpp"
#include "scene/vec.hpp"

#include <functional>
#include <span>
#include <vector>

namespace gnomon::api {

/// What may go along with comparisons; all may be left out.
struct CompareHooks {
    /// Draws and answers in place of the session's own, of which it may be a wrapper.
    const analysis::Renderers* renderers = nullptr;
    /// Told of each comparison as soon as it is made.
    std::function<void(analysis::Comparison&)> finish;
};

/// Compares what GL's shadow maps say with what is true, for each light of a job.
/// @param jobs  those that the session was made of.
/// @return  In their order. They refer to the session's scene.
/// @throws scene::InputError, scene::EnvironmentError, std::invalid_argument  as
///                                                          `analysis::compare_each` does.
[[nodiscard]] std::vector<analysis::Comparison> compare(const ComparisonSession& session,
                                                        std::span<const scene::LightJob> jobs,
                                                        const CompareHooks& hooks = {});

/// The point that each pixel shows [m]: computed, or as another renderer gave it; NaN where there
/// is none.
[[nodiscard]] scene::Image<scene::Vec3f> points_of(const analysis::Comparison& comparison);

} // namespace gnomon::api
