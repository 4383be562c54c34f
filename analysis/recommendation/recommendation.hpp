#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/lookup/amounts.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::analysis {

/// A constant bias as a job file writes it.
struct RoundedBias {
    std::string key; ///< "bias.constant = 0.0075", or of another unit where the job has that
    float bias = 0;  ///< the same bias in depth units
    const scene::BiasUnit* unit = &scene::bias_in_depth;
    double value = 0; ///< the value in that unit; in depth units equal to `bias`
};

/// The bias near `middle` with the fewest digits, at least two, that lies in the run.
/// @param middle    In the run; depth units, at least 0.
/// @param settings  The job's own; determines the unit.
[[nodiscard]] RoundedBias rounded_bias(float middle, const BiasInterval& run,
                                       const scene::BiasSettings& settings,
                                       const scene::LightFrustum& frustum);

/// A constant bias in three units.
struct BiasLength {
    float depth = 0;   ///< depth units
    double metres = 0; ///< along the light's axis, at the median receiver [m]
    double texels = 0; ///< those metres in world-space texel widths there

    friend bool operator==(const BiasLength&, const BiasLength&) = default;
};

/// Converts biases to lengths in metres and texels, at the median receiver of a map.
struct BiasLengths {
    scene::LightFrustum frustum;
    int resolution_texels = 0;
    double light_distance_m = 0; ///< median light distance of the scored receivers [m]
    /// The map whose texels and depth range convert biases: of several, the one that most receivers
    /// read. Empty: `frustum`.
    std::optional<scene::LightFrustum> read_map = {};
    double read_map_scale = 1; ///< factor of the bias of `frustum` in that map

    /// The map that converts biases to lengths.
    [[nodiscard]] const scene::LightFrustum& conversion_map() const;
    /// A bias in all three units; infinite in each for an infinite bias.
    [[nodiscard]] BiasLength of(float bias) const;
    /// The bias that is this many texels longer, but at most 1 if `bias` is, since 1 lights all of
    /// a map.
    /// @param bias  Normal, > 0.
    [[nodiscard]] float lengthened(float bias, double texels) const;
};

/// Converts a view's biases to lengths in one of its maps.
/// @param map  The one that most receivers read (`most_read_map`).
[[nodiscard]] BiasLengths bias_lengths_in(const scene::View& view, int resolution_texels,
                                          double light_distance_m, std::size_t map);

/// Margin of a recommended bias above the lower end of its broad minimum [texels].
inline constexpr double margin_texels = 3;

/// How far a recommended bias lies above the lower end of its broad minimum.
enum class Margin : std::uint8_t {
    not_needed,    ///< the bias is 0
    whole,         ///< `margin_texels`
    cut_short,     ///< less, since the broad minimum is short: the geometric mean of its ends
    within_limits, ///< determined by the requested limits
};

struct RecommendedBias {
    float bias = 0; ///< depth units
    Margin margin = Margin::not_needed;
};

/// The bias to recommend from a broad minimum. If it contains 0, that is 0. Otherwise its lower end
/// plus three texels, but at most the geometric mean of its ends if the upper one is finite.
/// Source: docs/bias_curve.md#what-is-recommended.
[[nodiscard]] RecommendedBias recommended_bias(const BiasInterval& broad_minimum,
                                               const BiasLengths& lengths);

/// The recommended bias rounded to few digits, keeping three quarters of its margin.
/// @param within    The biases to choose from; includes the recommended one.
/// @param settings  As in `rounded_bias`.
[[nodiscard]] RoundedBias rounded_near(const RecommendedBias& recommended,
                                       const BiasInterval& broad_minimum,
                                       const BiasInterval& within,
                                       const scene::BiasSettings& settings,
                                       const scene::LightFrustum& frustum);

/// The errors with some setting.
struct Outcome {
    ErrorCounts errors;
    ErrorAmounts amounts;
    double softening = 0;        ///< the part of the amounts that is intended softening [px]
    double left_out = softening; ///< the part of the softening that is no error (`left_out`) [px]

    /// The amount of error without intended softening [px].
    [[nodiscard]] double error_amount() const { return amounts.total() - left_out; }
};

/// The recommended constant bias, and the range of biases that are nearly as good.
struct Recommendation {
    BiasLength bias; ///< `recommended_bias` (docs/bias_curve.md#what-is-recommended)
    BiasLength low;
    BiasLength high;     ///< infinite if nothing limits the bias
    Outcome outcome;     ///< with `bias`
    RoundedBias rounded; ///< a bias of the broad minimum with few digits, for people
    BiasLength rounded_length;
    Outcome rounded_outcome;
    /// Number of views considered; lengths and outcomes are of the job's own.
    std::size_t views = 1;
    Margin margin = Margin::whole;
};

/// The recommendation if each verdict is one comparison, so that amounts equal counts.
/// @param settings  The job's biases, which determine the unit.
/// @return  Empty if no scored pixel is lit.
[[nodiscard]] std::optional<Recommendation> recommend_by_count(const BiasCurve& curve,
                                                               const BiasLengths& lengths,
                                                               const scene::BiasSettings& settings);

} // namespace gnomon::analysis
