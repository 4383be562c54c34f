#pragma once

#include "scene/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::methods {

/// How the taps of a kernel lie in a disc, or of a grid in a square, of radius 1.
enum class TapPattern : std::uint8_t {
    grid,    ///< rows and columns, as far apart, to the square's border
    poisson, ///< anywhere, but far from each other
    vogel, ///< on a spiral: the i-th of n at √(i / (n − 1)), a golden angle after the one before
    vogel_areas, ///< on a spiral, in the middle of n rings of equal area: at √((i + 1/2) / n)
};

/// How much the taps of a kernel count.
enum class TapWeights : std::uint8_t {
    equal,
    tent,     ///< falls linearly, to 0 one tap beyond the radius
    gaussian, ///< of standard deviation 1/2
};

/// A kernel of taps.
struct TapKernel {
    std::vector<scene::Vec2f> places; ///< the first is nearest to the middle, and but for
                                      ///< `vogel_areas` there, at (0, 0); none is farther than 1
                                      ///< from it, along x or y
    std::vector<float> weights; ///< whole multiples of 2^-16 that sum to 1; empty: all the same
};

/// The most taps that a kernel can have: a grid's of 9 × 9.
inline constexpr int most_kernel_taps = 81;
/// The fewest.
inline constexpr int least_kernel_taps = 4;

/// The kernel of so many taps, which stands for ever: the same bits on every machine.
/// @param taps  from `least_kernel_taps` to `most_kernel_taps`; of a grid the square of an odd
///              number.
/// @throws std::invalid_argument  for other numbers.
/// Source: docs/methods/pcf.md#the-kernels.
[[nodiscard]] const TapKernel& tap_kernel(TapPattern pattern, int taps, TapWeights weights);

/// Whether there is a grid of so many taps: the square of an odd number.
[[nodiscard]] bool is_grid(int taps);

/// How many angles kernels are turned by.
inline constexpr std::size_t rotation_count = 64;

/// Cosine and sine of these angles, from 0 on and evenly around the circle.
[[nodiscard]] std::span<const scene::Vec2f> rotations();

} // namespace gnomon::methods
