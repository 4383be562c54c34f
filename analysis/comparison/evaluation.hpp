#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/pixels/statistics.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Distances of positions from their nearest surfaces.
struct ImportDistances {
    std::uint64_t points = 0;
    double median_m = 0;
    double p99_m = 0;
    double max_m = 0;
    double tolerance_m = 0; ///< limit of `p99_m`
};

/// The result of checking an imported case for mistakes.
struct ImportCheck {
    ImportDistances distances;
    /// Number of pixels that are not scored because a silhouette may cross them, if P comes from
    /// the centres of the camera's pixels. Empty if the renderer provides P.
    std::optional<std::uint64_t> silhouette_pixels = {};
    /// How much better than chance the mask agrees with the truth: the share of lit pixels that are
    /// lit, plus the share of blocked pixels that are shadowed, minus 1. Empty if one kind is
    /// missing.
    std::optional<double> agreement;
    std::string mistake = {};  ///< "units", "axes", …; empty: none found
    std::string sentence = {}; ///< names the mistake and the remedy; empty: none found
    std::string warning = {};  ///< about a deviation that no known mistake explains and that may be
                               ///< intended; often empty
};

/// A question that a case's data cannot answer, and the data it would need.
struct UnansweredQuestion {
    std::string what;
    std::string needs;
};

/// Pixels that are wrong by their bias, as far as r and d alone tell. Includes pixels that only
/// self-shadowing would shadow without bias, since that would take the texel to know.
struct BiasCauses {
    scene::Image<Cause> cause; ///< `bias`; `none` where right or unknown
    scene::Image<Label> label; ///< `peter_panning` or `overshadow`, or `none`
    std::uint64_t peter_panning = 0;
    std::uint64_t overshadow = 0; ///< caused by the bias
    std::uint64_t unknown = 0;    ///< wrong by precision, resolution or coverage

    [[nodiscard]] std::uint64_t bias() const { return peter_panning + overshadow; }
};

/// The data that only comparisons of another renderer's case have.
struct Evaluation {
    std::string case_name;
    int level = 0; ///< 1: the visible side is known
    std::vector<UnansweredQuestion> cannot_know;
    ImportCheck import_check;
    scene::Image<scene::Vec3f> points; ///< P; NaN where not scored
    scene::Image<scene::Vec3f> normal; ///< of T, on the visible side; NaN if unknown
    /// How far P's rounding box was grown to meet the plane of T [m]: the maximum, and the number
    /// of pixels.
    double largest_growth_m = 0;
    std::uint64_t grown_pixels = 0;
    /// Pixels farther from their surface than `most_distance_m`: unscored under any light.
    std::uint64_t off_surface_pixels = 0;
    double most_distance_m = 0;
    bool has_camera = false; ///< whether the view's camera is the renderer's
    bool has_map = false;    ///< whether the view's frustum is the renderer's
    /// Keys of the job that the case specifies; the others are meaningless.
    std::vector<std::string> given_keys;
    /// Scored pixels whose mask contradicts r, d and the case's bias; empty if unknown.
    std::optional<std::uint64_t> contradicted_pixels;
    std::optional<BiasCauses> bias_causes; ///< empty if unknown or if there is a diagnosis
    std::vector<ObjectErrors> by_object;
    /// From P to the blocker; empty without false-lit pixels.
    std::optional<Quantiles> false_lit_gap_m;
    std::optional<double> frame_s; ///< the renderer's time for drawing; empty if unknown
};

} // namespace gnomon::analysis
