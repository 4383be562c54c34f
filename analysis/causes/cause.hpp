#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace gnomon::analysis {

/// Why a pixel is wrong or partly wrong: the first repair that makes it right (docs/causes.md). The
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

/// The common name of an error (docs/causes.md). The values are the EXR codes.
enum class Label : std::uint8_t {
    none = 0,          ///< it is right
    acne = 1,          ///< false shadow by the receiver's self-shadowing surface
    peter_panning = 2, ///< false lit by the bias
    leak = 3,          ///< false lit where the map lost the blocker
    edge = 4,          ///< the jagged, displaced or softened border of a real shadow
    overshadow = 5,    ///< false shadow by the bias, or by what the map does not cover
    bleed = 6, ///< false lit though every texel shadows: only the method's formula lights it
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

/// Error amounts of wrong and partial pixels, by cause and label [px].
struct CauseAmounts {
    std::array<double, cause_names.size()> by_cause{};
    std::array<double, label_names.size()> by_label{};
    double shadow_softening = 0; ///< of lit pixels: border softening that a kernel intends
    double light_softening = 0;  ///< of blocked pixels

    [[nodiscard]] double softening() const { return shadow_softening + light_softening; }
    [[nodiscard]] double of(Cause cause) const { return by_cause[static_cast<std::size_t>(cause)]; }
    [[nodiscard]] double of(Label label) const { return by_label[static_cast<std::size_t>(label)]; }
};

/// The error by cause and label [px]: amounts without intended softening, or counts if verdicts are
/// not fractions.
struct NamedErrors {
    std::array<double, cause_names.size()> by_cause{};
    std::array<double, label_names.size()> by_label{};

    [[nodiscard]] double of(Cause cause) const { return by_cause[static_cast<std::size_t>(cause)]; }
    [[nodiscard]] double of(Label label) const { return by_label[static_cast<std::size_t>(label)]; }
};

/// @param has_fractions  Whether some verdict is neither right nor wholly wrong.
/// @param left_out       The part of the softening that is no error (`left_out`) [px].
[[nodiscard]] NamedErrors named_errors(const CauseCounts& counts, const CauseAmounts& amounts,
                                       bool has_fractions, double left_out);

/// Whether error i is the largest, or at least a quarter of all. Error 0 has no name.
template <std::size_t size>
[[nodiscard]] bool is_worth_naming(const std::array<double, size>& errors, std::size_t i)
{
    constexpr double quarter = 0.25;
    const double all = std::accumulate(errors.begin(), errors.end(), 0.0);
    return i > 0 && errors[i] > 0 &&
           (errors[i] == std::ranges::max(errors) || errors[i] >= quarter * all);
}

} // namespace gnomon::analysis
