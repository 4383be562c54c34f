#pragma once

#include "analysis/quantiles.hpp"
#include "scene/image.hpp"
#include "scene/layers.hpp"
#include "scene/triangles.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Scored pixels of one part of the image, and how many of them are wrong.
struct PartCounts {
    std::uint64_t lit = 0;          ///< truth lit
    std::uint64_t blocked = 0;      ///< truth blocked
    std::uint64_t false_shadow = 0; ///< truth lit, verdict shadowed
    std::uint64_t false_lit = 0;    ///< truth blocked, verdict lit

    [[nodiscard]] std::optional<double>
    false_shadow_rate() const; ///< of lit; empty if there is none
    [[nodiscard]] std::optional<double>
    false_lit_rate() const;                                 ///< of blocked; empty if there is none
    [[nodiscard]] std::optional<double> error_rate() const; ///< of both; empty if there is none
    friend bool operator==(const PartCounts&, const PartCounts&) = default;
};

/// What is broken down; all images of one size, which the caller keeps alive.
struct BreakdownInputs {
    const scene::Image<scene::PixelClass>& classes;
    const scene::LookupLayers& lookup;
    const scene::Image<float>& criticals; ///< critical bias, depth units
    const scene::Image<float>& zeta_m;    ///< light distance of the receiver [m]; finite if scored
    const scene::Image<float>& map_error_m; ///< stored minus exact ζ [m]; NaN: none; may be empty
    /// If set, verdicts are those of this constant bias, by the critical biases, and not the
    /// lookup's.
    std::optional<float> bias = {};

    [[nodiscard]] bool is_lit(std::size_t pixel) const
    {
        return bias ? criticals[pixel] <= *bias : scene::is_lit(lookup.samples[pixel].verdict);
    }
};

/// The pixels whose value lies in [lower, upper), the last bin's in [lower, upper].
struct ErrorBin {
    double lower = 0;
    double upper = 0;
    PartCounts counts;
    std::optional<Quantiles> needed_bias; ///< of the lit pixels' finite critical biases
    std::optional<Quantiles> map_error_m; ///< of the scored pixels that have one, signed [m]
};

/// By light distance ζ [m]: bins of equal width over the range of the scored pixels; one bin if
/// they are all equally far, none if there are none.
/// @throws std::invalid_argument  if `bins` < 1, the images differ in size, or a scored pixel's ζ
/// is
///                                not finite.
[[nodiscard]] std::vector<ErrorBin> errors_by_distance(const BreakdownInputs& inputs,
                                                       int bins = 32);

/// By the receiver's angle θ between geometric normal and light [rad]: bins of equal width from 0
/// to π/2, 5 degrees each unless told otherwise.
/// @throws std::invalid_argument  if `bins` < 1 or the images differ in size.
[[nodiscard]] std::vector<ErrorBin> errors_by_angle(const BreakdownInputs& inputs, int bins = 18);

struct ObjectErrors {
    std::string name;
    PartCounts counts;
};

/// By object that receives the light: one entry an object of the scene, in its order, also for
/// those that no pixel shows.
/// @param triangles  The triangle that each pixel shows; one of the scene where it is scored.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] std::vector<ObjectErrors>
errors_by_object(const scene::Image<scene::PixelClass>& classes, const scene::LookupLayers& lookup,
                 const scene::Image<std::uint32_t>& triangles, const scene::TriangleScene& scene);

} // namespace gnomon::analysis
