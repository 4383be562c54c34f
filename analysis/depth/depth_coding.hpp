#pragma once

#include "analysis/depth/split_depth.hpp"
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
    /// Of a float32, as a shader has it.
    [[nodiscard]] static DepthCoding float16();
    /// Of a float32, as lessons pack it.
    [[nodiscard]] static DepthCoding packed();
    /// The coding of a shadow map's depth format.
    [[nodiscard]] static DepthCoding of(scene::DepthFormat format);

    [[nodiscard]] scene::Spacing spacing() const { return traits_of(format_).spacing; }
    [[nodiscard]] bool is_float() const { return format_.is_float(); }
    /// Width of a code.
    [[nodiscard]] int bits() const { return format_.bits; }
    /// That of depth 1: 2^bits − 1, the bits of 1.0, or white.
    [[nodiscard]] std::uint32_t largest_code() const;

    /// The code of a depth, which is clamped to [0, 1] first: the nearest one,
    /// floor(d·(2^bits − 1) + ½), or the bits of the nearest float32; of the other floats, and
    /// packed, that of the nearest float32.
    [[nodiscard]] std::uint32_t nearest_code(double depth) const;
    /// The depth that a code stands for, in [0, 1].
    [[nodiscard]] double depth(std::uint32_t code) const;
    /// The same with 1 − d, both rounded once.
    [[nodiscard]] SplitDepth split_depth(std::uint32_t code) const;
    /// Bound on the distance of a depth from what its code stands for: q/2 with q = 1/(2^bits − 1),
    /// or half a unit in the last place, 2^(e − 24) for 2^e <= d < 2^(e+1) (2^-25 at 1); of a
    /// float16 2^(e − 11), and the float32's on top. Packed: with k = floor(256 d) that of the
    /// first byte, (min(k, 256 − k) + 1)/65280, and of the others 1/130050. Source:
    /// docs/depth_precision.md#rgba8.
    [[nodiscard]] double half_step(double depth) const;
    /// The depths between which `half_step` is constant, 0 and 1 apart, in no order.
    [[nodiscard]] std::vector<double> borders() const;

    friend bool operator==(const DepthCoding&, const DepthCoding&) = default;

private:
    explicit DepthCoding(scene::DepthFormat format) : format_{format} {}

    scene::DepthFormat format_; ///< unorm with as many bits, r32f, r16f or rgba8
};

/// Half a unit in the last place of the float32 at or next below |value|: 2^(e − 24) for
/// 2^e <= |value| < 2^(e+1), never below 2^-150.
[[nodiscard]] double half_float32_step(double value);

} // namespace gnomon::analysis
