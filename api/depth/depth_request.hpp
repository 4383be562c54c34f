#pragma once

#include "analysis/depth/depth_error.hpp"
#include "analysis/depth/depth_plan.hpp"
#include "analysis/depth/depth_study.hpp"
#include "api/depth/depth_measure.hpp"
#include "raster_gl/context.hpp"
#include "scene/depth/measured_planes.hpp"
#include "scene/light/frustum.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::api {

/// A frustum, and where in it the precision of depth is looked at.
struct DepthRequest {
    std::optional<double> near_m; ///< empty: 4, the textbook lesson's
    std::optional<double> far_m;  ///< empty: 50
    scene::MapContent content = scene::MapContent::depth;
    scene::Projection projection = scene::Projection::perspective;
    bool reversed = false;
    std::optional<scene::ClipRange> clip_range = {}; ///< empty: [0, 1] if reversed, else [−1, 1]
    int samples = 4096;                              ///< planes, from near to far
    double tilt_deg = 0;                             ///< of the planes, 0 to 80
    double offset_m = 0; ///< how far from the world's origin the camera stands, on each axis
    std::optional<double> tolerance_m = {}; ///< to hold against the error, 1e-15 to 1e15

    [[nodiscard]] bool is_gl_depth() const { return traits_of(content).is_gl_depth(); }
};

/// The names of the GL driver; empty if nothing was measured.
struct DepthDriver {
    std::string renderer;
    std::string version;
};

/// One format in a frustum, with samples of its error.
struct StudiedDepth {
    analysis::DepthStudy study;
    std::vector<analysis::DepthErrorRow> rows; ///< measured ones, or the formula's
    DepthDriver driver;
};

/// @throws scene::InputError  naming what is out of range, or does not go together.
void require_sound(const DepthRequest& request);

/// @param context  null: theory alone, because of `why_not_measured`.
/// @throws scene::InputError  naming what is out of range, or if the driver lacks the format.
[[nodiscard]] StudiedDepth study_depth(const DepthRequest& request, const DepthChoice& choice,
                                       const raster_gl::Context* context,
                                       const std::string& why_not_measured = {});

/// Every format as asked, and reversed float if that was not asked for.
/// @param context  null: theory alone.
[[nodiscard]] std::vector<analysis::DepthStudy>
study_all_formats(const DepthRequest& request, const raster_gl::Context* context,
                  const std::string& why_not_measured = {});

/// Which near plane each format needs for errors of at most `max_error_m` up to the request's far.
/// @throws scene::InputError  naming what is out of range.
[[nodiscard]] analysis::PlanTarget plan_target(const DepthRequest& request, double max_error_m);

/// The contents that have a precision of their own. What is even along the axis is an orthographic
/// projection's depth, and needs no word of its own.
[[nodiscard]] std::vector<std::string> studied_contents();

} // namespace gnomon::api
