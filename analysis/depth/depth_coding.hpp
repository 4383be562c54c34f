#pragma once

#include "analysis/depth/depth_mapping.hpp"
#include "scene/depth/depth_format.hpp"

#include <cstdint>
#include <vector>

namespace gnomon::analysis {

/// How a window depth in [0, 1] is stored: as one of 2^bits evenly spaced codes, as a float, or
/// packed into four bytes.
class DepthCoding {
public:
    /// code/(2^bits − 1).
    /// @param bits  [8, 32]
    /// @throws std::domain_error  if it is out of range.
    [[nodiscard]] static DepthCoding unorm(int bits);
    [[nodiscard]] static DepthCoding float32();
    /// A float16 of the float32 that a shader computes.
    [[nodiscard]] static DepthCoding float16();
    /// The four bytes into which lessons pack a float32.
    [[nodiscard]] static DepthCoding packed();
    /// The coding of a shadow map's depth format.
    [[nodiscard]] static DepthCoding of(scene::DepthFormat format);

    [[nodiscard]] scene::Spacing spacing() const { return traits_of(format_).spacing; }
    [[nodiscard]] bool is_float() const { return format_.is_float(); }
    /// Width of a code.
    [[nodiscard]] int bits() const { return format_.bits; }
    /// The code of depth 1: 2^bits − 1, the bits of 1.0, or white.
    [[nodiscard]] std::uint32_t largest_code() const;

    /// The code nearest to a depth, which is clamped to [0, 1]: floor(d·(2^bits − 1) + ½), or the
    /// bits of the nearest float32. Other floats and packed codes encode the nearest float32.
    [[nodiscard]] std::uint32_t nearest_code(double depth) const;
    /// The depth that a code stands for, in [0, 1].
    [[nodiscard]] double depth(std::uint32_t code) const;
    /// The depth and 1 − d, each rounded once.
    [[nodiscard]] SplitDepth split_depth(std::uint32_t code) const;
    /// Bound on the distance between a depth and the depth of its code: q/2 with q = 1/(2^bits −
    /// 1), or half a unit in the last place, 2^(e − 24) for 2^e <= d < 2^(e+1) (2^-25 at 1); for a
    /// float16 2^(e − 11) plus the float32's. Packed, with k = floor(256 d): (min(k, 256 − k) +
    /// 1)/65280 for the first byte and 1/130050 for the others. Source:
    /// docs/depth_precision.md#rgba8.
    [[nodiscard]] double half_step(double depth) const;
    /// The depths between which `half_step` is constant, without 0 and 1, in no order.
    [[nodiscard]] std::vector<double> borders() const;

    friend bool operator==(const DepthCoding&, const DepthCoding&) = default;

private:
    explicit DepthCoding(scene::DepthFormat format) : format_{format} {}

    scene::DepthFormat format_; ///< unorm with as many bits, r32f, r16f or rgba8
};

/// Half a unit in the last place of the float32 at or next below |value|: 2^(e − 24) for
/// 2^e <= |value| < 2^(e+1), never below 2^-150.
[[nodiscard]] double half_float32_step(double value);

/// A range of codes.
struct CodeRange {
    std::uint32_t lower = 0;
    std::uint32_t upper = 0;

    [[nodiscard]] bool holds(std::uint32_t code) const { return lower <= code && code <= upper; }
};

/// The codes of the depths next below and above, between which GL lets a conversion choose; equal
/// if the depth has a code.
/// @param coding  With codes that rise with the depth: not packed.
/// @param depth   clamped to [0, 1].
[[nodiscard]] CodeRange nearest_codes(const DepthCoding& coding, double depth);

/// The codes to which a driver may convert a float32 depth in [lowest, highest].
///
/// Either of the two nearest; with 32 bits also 2⌊2^31·d⌋, from rasterisers without unsigned
/// conversion: a signed integer of 31 bits, truncated and doubled. It lies below the two nearest
/// only if d < 2^-9, where a float32 has digits beyond 2^-32.
/// @param lowest, highest  clamped to [0, 1].
/// Source: docs/depth_precision.md#conversion.
[[nodiscard]] CodeRange converted_codes(const DepthCoding& coding, double lowest, double highest);

/// Whether a driver may convert some float32 depth in or next to [lowest, highest] to this code:
/// one of `converted_codes`, or, packed, the code of such a depth.
/// @param lowest, highest  clamped to [0, 1].
[[nodiscard]] bool may_be_converted(const DepthCoding& coding, std::uint32_t code, double lowest,
                                    double highest);

/// Bound on how far the depth of such a code lies below a float32 depth of at least `lowest`: one
/// step, but 2^-31, nearly two steps, for 32 bits and lowest < 2^-9; packed: the half step.
/// @param lowest  clamped to [0, 1].
[[nodiscard]] double conversion_drop(const DepthCoding& coding, double lowest);
/// Bound on how far it lies above a float32 depth of at most `highest`: one step; packed: the half
/// step.
/// @param highest  clamped to [0, 1].
[[nodiscard]] double conversion_rise(const DepthCoding& coding, double highest);

} // namespace gnomon::analysis
