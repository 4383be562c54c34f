#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon::analysis {

/// Why a pixel is wrong, or partly so: the first repair that makes it right (docs/causes.md). The
/// values are the EXR codes.
enum class Cause : std::uint8_t {
    none = 0,       ///< it is right
    bias = 1,       ///< right without any bias
    precision = 2,  ///< right with exact depths at the same texels
    resolution = 3, ///< right with an infinitely fine map
    coverage = 4,   ///< right only without near, far, frustum and culling
    filter = 5,     ///< right with the texel alone that holds the receiver
};
inline constexpr std::array<std::string_view, 6> cause_names{"none",       "bias",     "precision",
                                                             "resolution", "coverage", "filter"};

/// What people call it (docs/causes.md). The values are the EXR codes.
enum class Label : std::uint8_t {
    none = 0,          ///< it is right
    acne = 1,          ///< false shadow by the receiver's self-shadowing surface
    peter_panning = 2, ///< false lit by the bias
    leak = 3,          ///< false lit where the map lost the blocker
    edge = 4,          ///< the jagged, displaced or softened border of a real shadow
    overshadow = 5,    ///< false shadow by the bias, or by what the map does not cover
    bleed = 6,         ///< false lit though every texel shadows: by the method's formula alone
};
inline constexpr std::array<std::string_view, 7> label_names{
    "none", "acne", "peter_panning", "leak", "edge", "overshadow", "bleed"};

/// Wrong pixels of each cause and label.
struct CauseCounts {
    std::array<std::uint64_t, cause_names.size()> by_cause{};
    std::array<std::uint64_t, label_names.size()> by_label{};

    [[nodiscard]] std::uint64_t of(Cause cause) const
    {
        return by_cause[static_cast<std::size_t>(cause)];
    }
    [[nodiscard]] std::uint64_t of(Label label) const
    {
        return by_label[static_cast<std::size_t>(label)];
    }
};

/// The amounts of error of wrong and partial pixels by cause and label [px].
struct CauseAmounts {
    std::array<double, cause_names.size()> by_cause{};
    std::array<double, label_names.size()> by_label{};
    double shadow_softening = 0; ///< of lit pixels: what a kernel does to a border on purpose
    double light_softening = 0;  ///< of blocked pixels

    [[nodiscard]] double softening() const { return shadow_softening + light_softening; }
    [[nodiscard]] double of(Cause cause) const { return by_cause[static_cast<std::size_t>(cause)]; }
    [[nodiscard]] double of(Label label) const { return by_label[static_cast<std::size_t>(label)]; }
};

} // namespace gnomon::analysis
