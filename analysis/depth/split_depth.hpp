#pragma once

namespace gnomon::analysis {

/// A window depth d in [0, 1], and 1 − d on its own: near 1, where a perspective crowds depths, d
/// alone would have lost the digits that distances hang on.
struct SplitDepth {
    double depth = 0;
    double complement = 1;
};

/// a − b, from the halves that are small at b: off by a few 2^-53 of these, not of 1.
[[nodiscard]] inline double difference(const SplitDepth& a, const SplitDepth& b)
{
    return b.depth < b.complement ? a.depth - b.depth : b.complement - a.complement;
}

} // namespace gnomon::analysis
