#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/limits/bias_rows.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A band of light distances ζ [m]: an octave [2^k, 2^(k + 1)), or [-2^(k + 1), -2^k), since a
/// directional light's ζ may be negative. Next to 0 lie [0, 2^-10) and [-2^-10, 0). The outermost
/// bands are unbounded from 2^50 on. Bands are equal in every run, wherever its near plane and
/// pixels lie.
struct LightDistanceBand {
    int index = 0; ///< in ascending order of ζ; band 0 begins at ζ = 0
    static constexpr int first_octave = -10;
    static constexpr int last_octave = 50;
    static constexpr int highest = last_octave - first_octave + 1;
    static constexpr int lowest = -1 - highest;

    /// −∞ for the lowest band.
    [[nodiscard]] double lower_m() const;
    /// +∞ for the highest band.
    [[nodiscard]] double upper_m() const;
    friend auto operator<=>(const LightDistanceBand&, const LightDistanceBand&) = default;
};

/// @param light_distance_m  Not NaN.
[[nodiscard]] LightDistanceBand light_distance_band_of(float light_distance_m);

/// Wrong and partial pixels of one kind.
struct KindOfError {
    bool is_false_lit = false; ///< of blocked pixels; false: of lit ones
    Cause cause = Cause::none;
    Label label = Label::none;
    std::uint64_t pixels = 0; ///< wrong pixels
    double amount = 0;        ///< error amount of wrong and partial pixels, the label's share [px]

    friend bool operator==(const KindOfError&, const KindOfError&) = default;
};

/// A cell of the table of objects by bands of light distance: the scored pixels of all objects of
/// one name in one band, with their errors.
struct ErrorBucket {
    std::string object;
    LightDistanceBand band;
    std::uint64_t lit = 0;           ///< truth lit
    std::uint64_t blocked = 0;       ///< truth blocked
    std::vector<KindOfError> errors; ///< nonzero ones, by side, cause and label

    friend bool operator==(const ErrorBucket&, const ErrorBucket&) = default;
};

/// The cell of each scored pixel.
struct CellMap {
    static constexpr std::uint16_t none = std::numeric_limits<std::uint16_t>::max();
    /// A scene with more cells in view gets none, since they would fill the store.
    static constexpr std::size_t most_cells = 512;

    scene::Image<std::uint16_t> cell; ///< index into `cells`; `none` where no pixel is scored
    std::vector<ErrorBucket> cells;   ///< by object and band, without errors; may be empty
};

/// Assigns the scored pixels to cells and counts them. Returns no cells if there would be too many.
/// @param triangles         The triangle that each pixel shows; one of the scene where it is
///                          scored.
/// @param light_distance_m  Light distance of the scored pixels [m], from `light_distances_m`.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] CellMap find_error_buckets(const scene::Image<scene::PixelClass>& classes,
                                         const scene::Image<std::uint32_t>& triangles,
                                         const scene::Image<float>& light_distance_m,
                                         const scene::TriangleScene& scene);

/// The cells with their errors at each of several biases.
/// @param biases  Ascending, 0 or normal.
/// @return  The cells at each bias, in the order of the map; empty if the map has none.
/// @throws std::invalid_argument  as `count_rows`.
[[nodiscard]] std::vector<std::vector<ErrorBucket>>
count_error_buckets(const CellMap& map, const BiasRowInputs& inputs, std::span<const float> biases);

} // namespace gnomon::analysis
