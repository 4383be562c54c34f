#pragma once

#include "scene/job/keys/key.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::methods {

/// How a kernel's taps are placed in a disc (a grid's: a square) of radius 1.
enum class TapPattern : std::uint8_t {
    grid,        ///< equally spaced rows and columns, up to the square's border
    poisson,     ///< irregular, but far from each other
    vogel,       ///< on a spiral by golden angles: the i-th of n at √(i / (n − 1))
    vogel_areas, ///< on that spiral, in the middle of n rings of equal area: at √((i + 1/2) / n)
};

/// The weights of a kernel's taps.
enum class TapWeights : std::uint8_t {
    equal,
    tent,     ///< falls linearly, to 0 one tap beyond the radius
    gaussian, ///< of standard deviation 1/2
};

/// A kernel of taps.
struct TapKernel {
    std::vector<scene::Vec2f> places; ///< the first is nearest to the middle, and except in
                                      ///< `vogel_areas` there, at (0, 0); none is farther than 1
                                      ///< from it, along x or y
    std::vector<float> weights;       ///< multiples of 2^-16 that sum to 1; empty: equal
};

/// Most taps of a kernel: a grid of 9 × 9.
inline constexpr int most_kernel_taps = 81;
/// Fewest taps of a kernel.
inline constexpr int least_kernel_taps = 4;

/// The kernel with this many taps, in static memory; bit-identical on every machine.
/// @param taps  from `least_kernel_taps` to `most_kernel_taps`; for a grid, the square of an odd
///              number.
/// @throws std::invalid_argument  for other numbers.
/// Source: docs/methods/pcf.md#the-kernels.
[[nodiscard]] const TapKernel& tap_kernel(TapPattern pattern, int taps, TapWeights weights);

/// Whether a grid can have this many taps: the square of an odd number.
[[nodiscard]] bool is_grid(int taps);

/// Number of angles by which kernels are rotated.
inline constexpr std::size_t rotation_count = 64;

/// Cosine and sine of these angles, evenly spaced from 0.
[[nodiscard]] std::span<const scene::Vec2f> rotations();

/// Keys of methods with scattered taps: pattern, number, rotation.
[[nodiscard]] const scene::Key& pattern_key();
[[nodiscard]] const scene::Key& taps_key();
[[nodiscard]] const scene::Key& turned_key();

/// The job's values of these keys.
[[nodiscard]] TapPattern tap_pattern(const scene::Job& job);
[[nodiscard]] int tap_count(const scene::Job& job);
[[nodiscard]] bool is_turned(const scene::Job& job);

/// The job's kernel; the smallest one for an impossible grid, which `check_taps` refuses.
[[nodiscard]] const TapKernel& tap_kernel(const scene::Job& job, TapWeights weights);

/// @throws scene::InputError  if the job asks for a grid whose number of taps is not an odd square.
void check_taps(const scene::Job& job);

} // namespace gnomon::methods
