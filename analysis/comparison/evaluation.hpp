#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/pixels/quantiles.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// How far positions are from the surfaces nearest to them.
struct ImportDistances {
    std::uint64_t points = 0;
    double median_m = 0;
    double p99_m = 0;
    double max_m = 0;
    double tolerance_m = 0; ///< of `p99_m`
};

/// What of a case is as it should be, and what looks like a mistake.
struct ImportCheck {
    ImportDistances distances;
    /// P is what the centres of the camera's pixels show, and so many pixels that show something
    /// are not judged because a silhouette may cross them; empty: the renderer says P.
    std::optional<std::uint64_t> silhouette_pixels = {};
    /// How much better than chance mask and truth agree: share of lit pixels that are lit plus
    /// share of blocked ones that are shadowed, minus 1; empty where one kind is missing.
    std::optional<double> agreement;
    std::string mistake = {};  ///< "units", "axes", …; empty: none found
    std::string sentence = {}; ///< that names the mistake and what to do; empty: none found
    std::string warning = {};  ///< of what no mistake explains, and may be as it is; often empty
};

/// Something that a case's data cannot tell, and what would tell it.
struct UnansweredQuestion {
    std::string what;
    std::string needs;
};

/// What r and d alone tell of the causes: which pixels are wrong by their bias. Those that without
/// it only their own surface would shadow are among them, as that takes the texel.
struct BiasCauses {
    scene::Image<Cause> cause; ///< `bias`, or `none` where it is right or not known
    scene::Image<Label> label; ///< `peter_panning` or `overshadow`, or `none`
    std::uint64_t peter_panning = 0;
    std::uint64_t overshadow = 0; ///< by the bias
    std::uint64_t unknown = 0;    ///< wrong by precision, resolution or coverage

    [[nodiscard]] std::uint64_t bias() const { return peter_panning + overshadow; }
};

/// What makes a comparison that of another renderer's case.
struct Evaluation {
    std::string case_name;
    int level = 0; ///< 1: the side that is seen is known
    std::vector<UnansweredQuestion> cannot_know;
    ImportCheck import_check;
    scene::Image<scene::Vec3f> points; ///< P; NaN where nothing is judged
    scene::Image<scene::Vec3f> normal; ///< of T, on the side that is seen; NaN: not known
    /// By how much P's rounding box was grown to meet the plane of T [m]: the largest, and how
    /// many.
    double largest_growth_m = 0;
    std::uint64_t grown_pixels = 0;
    /// Farther from their surface than `most_distance_m`: left open, whatever the light.
    std::uint64_t off_surface_pixels = 0;
    double most_distance_m = 0;
    bool has_camera = false; ///< the view's camera is the renderer's
    bool has_map = false;    ///< the view's frustum is the renderer's
    /// Keys of the job that the case gives; the others mean nothing.
    std::vector<std::string> given_keys;
    /// Scored pixels whose mask is not what r, d and the bias of the case give; empty: not known.
    std::optional<std::uint64_t> contradicted_pixels;
    std::optional<BiasCauses> bias_causes; ///< empty: not known, or there is a diagnosis
    std::vector<ObjectErrors> by_object;
    std::optional<Quantiles> false_lit_gap_m; ///< from P to the blocker; empty: none is false lit
    std::optional<double>
        frame_s; ///< how long drawing took, as the renderer says; empty: not known
};

} // namespace gnomon::analysis
