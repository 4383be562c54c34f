#pragma once

#include "analysis/depth/split_depth.hpp"
#include "scene/job/job.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// How a window depth in [0, 1] is stored: as one of 2^bits evenly spaced codes, or as a float32.
class DepthCoding {
public:
    /// code/(2^bits − 1).
    /// @param bits  [8, 32]
    /// @throws std::domain_error  if it is out of range.
    [[nodiscard]] static DepthCoding unorm(int bits);
    [[nodiscard]] static DepthCoding float32();
    /// The coding of a shadow map's depth format.
    [[nodiscard]] static DepthCoding of(scene::DepthFormat format);

    [[nodiscard]] bool is_float() const { return bits_ == 0; }
    /// Width of a code: 32 for float32.
    [[nodiscard]] int bits() const { return is_float() ? 32 : bits_; }
    /// 2^bits − 1, or the bits of 1.0.
    [[nodiscard]] std::uint32_t largest_code() const;

    /// The code nearest to a depth, which is clamped to [0, 1] first: floor(d·(2^bits − 1) + ½), or
    /// the bits of the nearest float32.
    [[nodiscard]] std::uint32_t nearest_code(double depth) const;
    /// The depth that a code stands for, in [0, 1].
    [[nodiscard]] double depth(std::uint32_t code) const;
    /// The same with 1 − d, both rounded once.
    [[nodiscard]] SplitDepth split_depth(std::uint32_t code) const;
    /// Largest distance of a depth from the nearest code: q/2 with q = 1/(2^bits − 1), or half a
    /// unit in the last place, 2^(e − 24) for 2^e <= d < 2^(e+1) (2^-25 at 1).
    [[nodiscard]] double half_step(double depth) const;

    friend bool operator==(const DepthCoding&, const DepthCoding&) = default;

private:
    explicit DepthCoding(int bits) : bits_{bits} {}

    int bits_; ///< 0: float32
};

/// Half a unit in the last place of the float32 at or next below |value|: 2^(e − 24) for
/// 2^e <= |value| < 2^(e+1), never below 2^-150.
[[nodiscard]] double half_float32_step(double value);

} // namespace gnomon::analysis
