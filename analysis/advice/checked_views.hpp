#pragma once

#include "analysis/metrics/metrics.hpp"
#include "analysis/renderers.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A view to derive advice from: a job of the same scene with explicit camera and light.
struct AdviceView {
    std::string name; ///< "own", "camera 1", "light 1", or a case's
    scene::Job job;
};

/// The views to use besides the job's own.
struct ViewRequest {
    int cameras = 0;               ///< generated around the job's own
    int lights = 0;                ///< generated around the job's own
    std::vector<AdviceView> cases; ///< given views, each of which must have scored pixels
};

/// A view with its receivers and their truth.
struct CheckedView {
    AdviceView view;
    scene::ReceiverLayers receivers;
    scene::Truth truth;
    ClassCounts pixels;
    double median_light_distance_m = 0; ///< light distance of the scored receivers [m]
};

struct CheckedViews {
    std::vector<CheckedView> views; ///< the job's own first; at least one
    std::size_t passed_over = 0;    ///< number of generated views with too few scored pixels
    bool turns_light = false;       ///< whether their lights differ

    [[nodiscard]] const CheckedView& own() const { return views.front(); }
};

/// Draws and evaluates the views. Skips a generated view that scores less than a tenth of the job's
/// own, and a camera below the whole scene, which would look at it from under the ground. Then
/// takes the next of the sequence, trying at most four times as many as requested.
/// @throws scene::InputError  if the job's own view or a case scores nothing, or if lights around a
///                            point light are requested.
/// Source: docs/tune.md#views.
[[nodiscard]] CheckedViews judge_views(const scene::Job& job, const scene::SceneFile& file,
                                       const Renderers& renderers, const ViewRequest& request);

/// The job with the camera, light and image of another view.
[[nodiscard]] scene::Job with_view_of(scene::Job job, const scene::Job& view);

} // namespace gnomon::analysis
