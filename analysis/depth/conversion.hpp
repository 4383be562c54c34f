#pragma once

#include "analysis/depth/depth_coding.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// A run of codes.
struct CodeRange {
    std::uint32_t lower = 0;
    std::uint32_t upper = 0;

    [[nodiscard]] bool holds(std::uint32_t code) const { return lower <= code && code <= upper; }
};

/// The codes of the depths next below and next above, the same if the depth has a code: those
/// that GL allows a conversion.
/// @param coding  of codes that rise with the depth: not packed.
/// @param depth   clamped to [0, 1].
[[nodiscard]] CodeRange nearest_codes(const DepthCoding& coding, double depth);

/// The codes that a driver may convert any float32 depth in [lowest, highest] to.
///
/// Either of the two nearest; with 32 bits also 2⌊2^31·d⌋, as a rasteriser without unsigned
/// conversion has it: a signed integer of 31 bits, truncated and doubled. It falls below the two
/// nearest only for d < 2^-9, where a float32 has digits beyond 2^-32.
/// @param lowest, highest  clamped to [0, 1].
/// Source: docs/depth_precision.md#conversion.
[[nodiscard]] CodeRange converted_codes(const DepthCoding& coding, double lowest, double highest);

/// Whether a driver may convert some float32 depth in [lowest, highest], or next to it, to this
/// code: one of `converted_codes`; packed: the code of some such depth.
/// @param lowest, highest  clamped to [0, 1].
[[nodiscard]] bool may_be_converted(const DepthCoding& coding, std::uint32_t code, double lowest,
                                    double highest);

/// Bound on how far below a float32 depth of at least `lowest` the depth of such a code lies: one
/// step, but 2^-31, nearly two steps, for 32 bits and lowest < 2^-9; packed: the half step.
/// @param lowest  clamped to [0, 1].
[[nodiscard]] double conversion_drop(const DepthCoding& coding, double lowest);
/// Bound on how far above a float32 depth of at most `highest` it lies: one step; packed:
/// the half step.
/// @param highest  clamped to [0, 1].
[[nodiscard]] double conversion_rise(const DepthCoding& coding, double highest);

} // namespace gnomon::analysis
