#pragma once

#include "analysis/lookup/amounts.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace gnomon::analysis {

/// Number of pixels of each class and of each reason.
struct ClassCounts {
    std::uint64_t total = 0;
    std::array<std::uint64_t, scene::pixel_class_count> by_class{};   ///< by PixelClass
    std::array<std::uint64_t, scene::class_reason_count> by_reason{}; ///< by ClassReason

    [[nodiscard]] std::uint64_t of(scene::PixelClass pixel_class) const
    {
        return by_class[static_cast<std::size_t>(pixel_class)];
    }
    [[nodiscard]] std::uint64_t of(scene::ClassReason reason) const
    {
        return by_reason[static_cast<std::size_t>(reason)];
    }
    /// Scored pixels: lit and blocked.
    [[nodiscard]] std::uint64_t scored() const;
    ClassCounts& operator+=(const ClassCounts& other);
    /// Pixels in which GL or the exact ray sees a surface.
    [[nodiscard]] std::uint64_t surface() const;
};

/// Counts and amounts of the differences between verdict and truth.
struct Metrics {
    ClassCounts pixels;
    std::uint64_t false_shadow = 0; ///< truth lit, verdict shadowed
    std::uint64_t false_lit = 0;    ///< truth blocked, verdict lit
    /// false_shadow / scored lit; empty without lit pixels.
    std::optional<double> false_shadow_rate;
    /// false_lit / scored blocked; empty without blocked pixels.
    std::optional<double> false_lit_rate;
    std::optional<double> error_rate; ///< both / scored; empty without scored pixels
    ErrorAmounts amounts;
    std::optional<double> shadow_amount_rate; ///< amounts.shadow / scored lit
    std::optional<double> light_amount_rate;  ///< amounts.light / scored blocked
    std::optional<double> mean_abs_error;     ///< mean |verdict − truth| over the scored pixels

    /// Adds up counts and amounts of several images; rates are those of the sums.
    Metrics& operator+=(const Metrics& other);
};

/// Whether some verdict is neither right nor wholly wrong, so that amounts say more than counts.
[[nodiscard]] bool has_fractions(const Metrics& metrics);

[[nodiscard]] ClassCounts count_classes(const scene::Truth& truth);

/// Counts the wrong pixels, and adds up how far verdicts are from the truth.
/// @param taps  `LookupTraits::equal_taps` of the lookup: verdicts are multiples of 1/taps, and
///              their errors are added as integers; 0: as doubles.
/// @throws std::invalid_argument  if the layers differ in size.
/// @throws std::domain_error      if a scored pixel's verdict is not in [0, 1].
[[nodiscard]] Metrics measure(const scene::Truth& truth, const scene::LookupLayers& lookup,
                              int taps);

/// The wrong pixels of one verdict image.
struct VerdictErrors {
    std::uint64_t false_shadow = 0;
    std::uint64_t false_lit = 0;
    ErrorAmounts amounts;
};
/// The metrics of an image with these classes and errors.
[[nodiscard]] Metrics make_metrics(const ClassCounts& pixels, const VerdictErrors& errors);

} // namespace gnomon::analysis
