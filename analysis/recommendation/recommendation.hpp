#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/recommendation/rounded_bias.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace gnomon::analysis {

/// A constant bias in three units.
struct BiasLength {
    float depth = 0;   ///< depth units
    double metres = 0; ///< along the light's axis, at the median receiver [m]
    double texels = 0; ///< those metres over the world width of a texel there

    friend bool operator==(const BiasLength&, const BiasLength&) = default;
};

/// Biases as lengths: what converts one to metres and texels, a map and its median receiver.
struct BiasLengths {
    scene::LightFrustum frustum;
    int resolution_texels = 0;
    double light_distance_m = 0; ///< median light distance of the scored receivers [m]
    /// The map whose texels and depth range turn biases into lengths: of several the one that most
    /// receivers read. Empty: `frustum`.
    std::optional<scene::LightFrustum> read_map = {};
    double scale_there = 1; ///< what a bias of the frustum is multiplied with in it

    /// The map where biases are made lengths.
    [[nodiscard]] const scene::LightFrustum& told_in() const;
    /// A bias in all three units; infinite in each for an infinite bias.
    [[nodiscard]] BiasLength of(float bias) const;
    /// The bias that is so many texels longer, at most 1 where `bias` is: that lights all of a map.
    /// @param bias  Normal, > 0.
    [[nodiscard]] float lengthened(float bias, double texels) const;
};

/// Biases of a view as lengths in one of its maps.
/// @param map  The one that most receivers read (`most_read_map`).
[[nodiscard]] BiasLengths bias_lengths_in(const scene::View& view, int resolution_texels,
                                          double light_distance_m, std::size_t map);

/// By how much a recommended bias is longer than the least of its valley [texels].
inline constexpr double margin_texels = 3;

/// How far above its valley's lower end a recommended bias lies.
enum class Margin : std::uint8_t {
    not_needed,    ///< it is 0
    whole,         ///< `margin_texels`
    cut_short,     ///< less, for the valley is short: the geometric mean of its ends
    within_limits, ///< wherever errors meet the limits that were asked for
};

struct RecommendedBias {
    float bias = 0; ///< depth units
    Margin margin = Margin::not_needed;
};

/// What to take of a valley: 0 if it holds 0, else its lower end and three texels more, at most the
/// geometric mean of its ends where something limits the upper one.
/// Source: docs/bias_curve.md#what-is-recommended.
[[nodiscard]] RecommendedBias recommended_bias(const BiasInterval& broad_minimum,
                                               const BiasLengths& lengths);

/// The recommended bias with few digits, which leave three quarters of its margin.
/// @param within    The biases to choose from; the recommended one is one of them.
/// @param settings  As `rounded_bias` has them.
[[nodiscard]] RoundedBias rounded_near(const RecommendedBias& recommended,
                                       const BiasInterval& broad_minimum,
                                       const BiasInterval& within,
                                       const scene::BiasSettings& settings,
                                       const scene::LightFrustum& frustum);

/// What verdicts are worth with some setting.
struct Outcome {
    ErrorCounts errors;
    ErrorAmounts amounts;
    double softening = 0;        ///< the part of the amounts that a kernel softens borders by [px]
    double left_out = softening; ///< what of it is left out of the error (`left_out`) [px]

    /// By how much verdicts are wrong beside what a kernel softens on purpose [px].
    [[nodiscard]] double error_amount() const { return amounts.total() - left_out; }
};

/// The constant bias to take, and the biases that are nearly as good.
struct Recommendation {
    BiasLength bias; ///< `recommended_bias` (docs/bias_curve.md#what-is-recommended)
    BiasLength low;
    BiasLength high;     ///< infinite: nothing limits the bias
    Outcome outcome;     ///< with `bias`
    RoundedBias rounded; ///< a bias of the valley with few digits, for people
    BiasLength rounded_length;
    Outcome rounded_outcome;
    std::size_t views = 1; ///< of which it is made; lengths and outcomes are of the job's own
    Margin margin = Margin::whole;
};

/// What is recommended where each verdict is one comparison: amounts are counts.
/// @param settings  The job's biases, which decide the unit to paste.
/// @return  Empty if no scored pixel is lit.
[[nodiscard]] std::optional<Recommendation> recommend_by_count(const BiasCurve& curve,
                                                               const BiasLengths& lengths,
                                                               const scene::BiasSettings& settings);

} // namespace gnomon::analysis
