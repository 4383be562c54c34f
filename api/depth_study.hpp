#pragma once

#include "analysis/depth/depth_error.hpp"
#include "analysis/depth/depth_plan.hpp"
#include "analysis/depth/depth_study.hpp"
#include "raster_gl/context.hpp"
#include "scene/depth/measured_planes.hpp"
#include "scene/light/frustum.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::api {

/// A depth coding, and its GL format if there is one.
struct DepthChoice {
    analysis::DepthCoding coding = analysis::DepthCoding::unorm(24);
    std::optional<scene::DepthFormat> format; ///< empty for theory only
    std::string name;                         ///< "d24", or "27-bit unorm"
    bool is_named = false;                    ///< requested by name, so no substitute is allowed
};

/// The format with a name or a number of bits: d16, d24, d32, else u8 … u24. 25 to 31 bits have no
/// GL format.
/// @param format  "" to choose by `bits`.
/// @throws scene::InputError  naming the argument.
[[nodiscard]] DepthChoice choose_format(const std::string& format, std::optional<int> bits);

/// Evaluates the formulas without measuring.
[[nodiscard]] analysis::DepthStudy study_theory(const DepthChoice& choice,
                                                const scene::MeasuredPlaneSettings& planes,
                                                const std::string& not_measured_because);

/// Computes theory and measurement of several formats on the same planes. A format that the driver
/// lacks is not measured; the study says why.
///
/// @throws scene::InputError  if the planes cannot be made, or GL clips all of them.
[[nodiscard]] std::vector<analysis::DepthStudy>
study_formats(const raster_gl::Context& context, const std::vector<DepthChoice>& choices,
              const scene::MeasuredPlaneSettings& settings);

/// A frustum, and the positions in it at which depth precision is studied.
struct DepthRequest {
    std::optional<double> near_m; ///< default 4, as in the textbook lesson
    std::optional<double> far_m;  ///< default 50
    scene::MapContent content = scene::MapContent::depth;
    scene::Projection projection = scene::Projection::perspective;
    bool reversed = false;
    std::optional<scene::ClipRange> clip_range = {}; ///< default [0, 1] if reversed, else [−1, 1]
    int samples = 4096;                              ///< planes, from near to far
    double tilt_deg = 0;                             ///< of the planes, 0 to 80
    double offset_m = 0; ///< the camera's distance from the world origin, on each axis
    std::optional<double> tolerance_m = {}; ///< to compare with the error, 1e-15 to 1e15

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
    std::vector<analysis::DepthErrorRow> rows; ///< measured, or from the formula
    DepthDriver driver;
};

/// @throws scene::InputError  naming the argument that is out of range or in conflict.
void require_sound(const DepthRequest& request);

/// @param context  null for theory only, with the reason in `why_not_measured`.
/// @throws scene::InputError  naming the argument that is out of range, or if the driver lacks the
///                            format.
[[nodiscard]] StudiedDepth study_depth(const DepthRequest& request, const DepthChoice& choice,
                                       const raster_gl::Context* context,
                                       const std::string& why_not_measured = {});

/// Studies every format as requested, and reversed d32f as well.
/// @param context  null for theory only.
[[nodiscard]] std::vector<analysis::DepthStudy>
study_all_formats(const DepthRequest& request, const raster_gl::Context* context,
                  const std::string& why_not_measured = {});

/// The target for planning near planes: errors of at most `max_error_m` up to the request's far
/// plane.
/// @throws scene::InputError  naming the argument that is out of range.
[[nodiscard]] analysis::PlanTarget plan_target(const DepthRequest& request, double max_error_m);

/// The map contents with a distinct precision. Linear depth along the axis equals an orthographic
/// projection's, so it is not listed.
[[nodiscard]] std::vector<std::string> studied_contents();

} // namespace gnomon::api
