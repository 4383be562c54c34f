#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_mapping.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A depth format with its direction and clip range.
struct PlannedFormat {
    std::string name; ///< as in a job file: "d24"
    DepthCoding coding = DepthCoding::unorm(24);
    bool reversed = false; ///< with the clip range [0, 1]

    [[nodiscard]] scene::DepthRange range(scene::Projection projection, double near_m,
                                          double far_m) const;
};
/// d16, d24, d32f, and d32f reversed.
[[nodiscard]] std::vector<PlannedFormat> planned_formats();

/// Bound on GL's error at a distance of a flat plane, seen by a camera at the world's origin [m]:
/// either of the two nearest codes, or the nearest float32, plus float32 evaluation of projection,
/// division and viewport.
///
/// It leaves out what the rasteriser adds in steep or small triangles; `gnomon doctor --depth`
/// measures that.
[[nodiscard]] double gl_error_bound_m(const DepthMapping& mapping, const DepthCoding& coding,
                                      double light_distance_m);

/// The requirements on a depth buffer.
struct PlanTarget {
    scene::Projection projection = scene::Projection::perspective;
    double max_error_m = 0.01; ///< > 0
    double far_m = 200;
    std::optional<double> near_m; ///< empty: to be found
};

/// How well a format meets a target.
struct PlanAnswer {
    PlannedFormat format;
    /// The smallest near plane with which no distance up to far errs by more than the target [m];
    /// the target's own if it has one that meets it; empty if none below far does.
    std::optional<double> near_m;
    std::optional<double> formula_near_m; ///< for the stored code alone: a lower limit
    /// With the target's near plane: errors stay within the target from near up to here [m]. Empty
    /// without a near plane, or if even near exceeds the target.
    std::optional<double> reach_m;
    /// Bound with near_m, else with the target's near plane [m]; 0 without either.
    double error_at_far_m = 0;
};

/// One answer per planned format.
/// @throws std::domain_error  unless max_error > 0, far is finite (and > 0 for a perspective), and
///                            near, if given, makes a range with it.
/// Source: docs/depth_precision.md#planning.
[[nodiscard]] std::vector<PlanAnswer> plan_depth(const PlanTarget& target);

} // namespace gnomon::analysis
