#pragma once

#include "analysis/limits/bias_rows.hpp"
#include "analysis/metrics/binning.hpp"
#include "analysis/pixels/quantiles.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A subset of the scored pixels, and how many of them are wrong.
struct SubsetCounts {
    std::uint64_t lit = 0;          ///< truth lit
    std::uint64_t blocked = 0;      ///< truth blocked
    std::uint64_t false_shadow = 0; ///< truth lit, verdict shadowed
    std::uint64_t false_lit = 0;    ///< truth blocked, verdict lit
    double shadow_amount = 0;       ///< Σ of how much too dark verdicts are [px]
    double light_amount = 0;        ///< Σ of how much too bright they are [px]

    friend bool operator==(const SubsetCounts&, const SubsetCounts&) = default;
};

/// What is broken down; all images of one size, which the caller keeps alive.
struct BreakdownInputs {
    const scene::Truth& truth;
    const scene::LookupLayers& lookup;
    const scene::Image<float>& criticals;   ///< critical bias, depth units
    const scene::Image<float>& map_error_m; ///< stored minus exact ζ [m]; NaN: none; may be empty
    int taps = 1; ///< the verdicts' fractions are multiples of 1/taps; 0: any
};

/// The pixels whose value lies in [lower, upper), the last bin's in [lower, upper].
struct ErrorBin {
    double lower = 0;
    double upper = 0;
    SubsetCounts counts;
    std::optional<Quantiles> needed_bias; ///< of the lit pixels' finite critical biases
    std::optional<Quantiles> map_error_m; ///< of the scored pixels that have one, signed [m]
    /// By distance: what storing depths alone may do to `map_error_m` [m].
    std::optional<double> envelope_m;
};

/// The errors of each bin. Needed bias and map error do not depend on the bias: they are found once
/// for all of `biases`.
/// @param biases    Verdicts are those of these constant biases, by the critical biases.
/// @param lit_taps  Of a pcfK lookup, for each bias how many taps of each pixel are lit; empty for
///                  one comparison.
/// @return  The bins of each bias, in the order of the biases.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] std::vector<std::vector<ErrorBin>>
errors_by_bin(const Binning& binning, const BreakdownInputs& inputs, std::span<const float> biases,
              std::span<const scene::Image<std::uint8_t>> lit_taps = {});
/// The same with the lookup's own verdicts.
[[nodiscard]] std::vector<ErrorBin> errors_by_bin(const Binning& binning,
                                                  const BreakdownInputs& inputs);

/// The lookup's own verdicts in each bin, and nothing of biases or of what the map stores.
/// @param taps  as in `BreakdownInputs`.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] std::vector<SubsetCounts> count_by_bin(const Binning& binning,
                                                     const scene::Truth& truth,
                                                     const scene::LookupLayers& lookup, int taps);

struct ObjectErrors {
    std::string name;
    SubsetCounts counts;
};

/// By object that receives the light: one entry an object of the scene, in its order, also for
/// those that no pixel shows.
/// @param triangles  The triangle that each pixel shows; one of the scene where it is scored.
/// @param taps       As in `BreakdownInputs`.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] std::vector<ObjectErrors>
errors_by_object(const scene::Truth& truth, const scene::LookupLayers& lookup,
                 const scene::Image<std::uint32_t>& triangles, const scene::TriangleScene& scene,
                 int taps);

/// The errors of the pixels that read one of a light's maps.
struct MapErrors {
    SubsetCounts counts;
    CauseCounts causes; ///< of the wrong ones
};

/// What a breakdown by map is made from; all images of one size.
struct MapBreakdownInputs {
    const scene::Truth& truth;
    const scene::LookupLayers& lookup;
    const scene::MapIndices& maps; ///< that the pixels read; empty where the light has but one
    std::size_t map_count = 1;     ///< of the light
    const CauseLayers& causes;
    int taps = 1; ///< as in `BreakdownInputs`
};

/// By map that the lookup read, where the light has several; none where it has one.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] std::vector<MapErrors> errors_by_map(const MapBreakdownInputs& inputs);

} // namespace gnomon::analysis
