#pragma once

#include "analysis/limits/bias_rows.hpp"
#include "analysis/metrics/binning.hpp"
#include "analysis/pixels/statistics.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/light/frustum.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Counts of a subset of the scored pixels, and its errors.
struct SubsetCounts {
    std::uint64_t lit = 0;          ///< truth lit
    std::uint64_t blocked = 0;      ///< truth blocked
    std::uint64_t false_shadow = 0; ///< truth lit, verdict shadowed
    std::uint64_t false_lit = 0;    ///< truth blocked, verdict lit
    double shadow_amount = 0;       ///< Σ by how much verdicts are too dark [px]
    double light_amount = 0;        ///< Σ by how much verdicts are too bright [px]

    friend bool operator==(const SubsetCounts&, const SubsetCounts&) = default;
};

/// Inputs of a breakdown; all images have one size and must stay alive.
struct BreakdownInputs {
    const scene::Truth& truth;
    const scene::LookupLayers& lookup;
    const scene::Image<float>& criticals; ///< critical bias, depth units
    /// Stored minus exact ζ [m]; NaN where unknown; may be empty.
    const scene::Image<float>& map_error_m;
    int taps = 1; ///< verdicts are multiples of 1/taps; 0: arbitrary fractions
};

/// The pixels whose value lies in [lower, upper); the last bin includes `upper`.
struct ErrorBin {
    double lower = 0;
    double upper = 0;
    SubsetCounts counts;
    std::optional<Quantiles> needed_bias; ///< quantiles of the lit pixels' finite critical biases
    /// Quantiles over the scored pixels that have an error, signed [m].
    std::optional<Quantiles> map_error_m;
    /// By distance: the largest error that storing depths alone may cause [m].
    std::optional<double> envelope_m;
};

/// The errors of each bin. Needed bias and map error do not depend on the bias, so they are found
/// once for all of `biases`.
/// @param biases    Constant biases; the critical biases give their verdicts.
/// @param lit_taps  For a pcfK lookup: the number of lit taps of each pixel, one image for each
///                  bias; empty for one comparison.
/// @return  The bins of each bias, in the order of the biases.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] std::vector<std::vector<ErrorBin>>
errors_by_bin(const Binning& binning, const BreakdownInputs& inputs, std::span<const float> biases,
              std::span<const scene::Image<std::uint8_t>> lit_taps = {});
/// The errors of each bin by the lookup's own verdicts.
[[nodiscard]] std::vector<ErrorBin> errors_by_bin(const Binning& binning,
                                                  const BreakdownInputs& inputs);

/// Counts the lookup's own verdicts in each bin.
/// @param taps  As in `BreakdownInputs`.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] std::vector<SubsetCounts> count_by_bin(const Binning& binning,
                                                     const scene::Truth& truth,
                                                     const scene::LookupLayers& lookup, int taps);

struct ObjectErrors {
    std::string name;
    SubsetCounts counts;
};

/// Errors by receiving object: one entry for each object of the scene, in its order, even if no
/// pixel shows it.
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
    CauseCounts causes; ///< of the wrong pixels
};

/// Inputs of a breakdown by map; all images have one size.
struct MapBreakdownInputs {
    const scene::Truth& truth;
    const scene::LookupLayers& lookup;
    /// The map that each pixel reads; empty if the light has one map.
    const scene::MapIndices& maps;
    std::size_t map_count = 1; ///< of the light
    const CauseLayers& causes;
    int taps = 1; ///< as in `BreakdownInputs`
};

/// Errors by the map that the lookup read; empty if the light has one map.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] std::vector<MapErrors> errors_by_map(const MapBreakdownInputs& inputs);

/// Sets the envelope of bins by light distance: the largest `error_envelope_m` within the bin, over
/// all of the light's maps, between near and far.
/// Source: docs/depth_precision.md#envelope.
void add_envelopes(std::vector<ErrorBin>& by_distance, std::span<const scene::LightFrustum> maps,
                   scene::DepthFormat format);

} // namespace gnomon::analysis
