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

/// A view that advice is made from: a job of the same scene, its camera and light written out.
struct AdviceView {
    std::string name; ///< "own", "camera 1", "light 1", or a case's
    scene::Job job;
};

/// Which views beside the job's own.
struct ViewRequest {
    int cameras = 0;               ///< generated around the job's own
    int lights = 0;                ///< the same
    std::vector<AdviceView> cases; ///< further ones, all of which must score something
};

/// A view with what is seen in it and what is true of that.
struct CheckedView {
    AdviceView view;
    scene::ReceiverLayers receivers;
    scene::Truth truth;
    ClassCounts pixels;
    double median_light_distance_m = 0; ///< light distance of the scored receivers [m]
};

struct CheckedViews {
    std::vector<CheckedView> views; ///< the job's own first; at least one
    std::size_t passed_over = 0;    ///< generated ones that score less than a tenth of it
    bool turns_light = false;       ///< whether their lights differ

    [[nodiscard]] const CheckedView& own() const { return views.front(); }
};

/// Draws and judges the views. Generated ones that score less than a tenth of what the job's own
/// does are passed over, and cameras below all of the scene, which look at it from under the
/// ground; then the next of the sequence is taken, up to four times as many as are asked for.
/// @throws scene::InputError  if the job's own view or a case scores nothing, or if lights around a
///                            point light are asked for.
/// Source: docs/tune.md#views.
[[nodiscard]] CheckedViews judge_views(const scene::Job& job, const scene::SceneFile& file,
                                       const Renderers& renderers, const ViewRequest& request);

/// The job with another view's camera and light, and image.
[[nodiscard]] scene::Job with_view_of(scene::Job job, const scene::Job& view);

} // namespace gnomon::analysis
