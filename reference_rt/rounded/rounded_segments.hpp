#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/pixels/shadow_segments.hpp"
#include "reference_rt/rounded/rounding_box.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::reference_rt {

/// A hypothesis: a pixel shows triangle T somewhere in its rounding box.
struct Hypothesis {
    std::size_t pixel = 0;
    std::uint32_t triangle = scene::no_triangle; ///< T
    double growth_m = 0;                         ///< growth of the box on each side
};

/// The verdict for all points of a hypothesis.
struct HypothesisVerdict {
    scene::PixelClass pixel_class = scene::PixelClass::indeterminate;
    std::uint32_t witness = scene::no_triangle; ///< if blocked: crosses the segments of all points
};

/// A hypothesis's geometry.
struct RoundedStart {
    ExactTriangle face; ///< T
    RoundingBox box{};
    scene::Vec3d point{}; ///< the rounded P
};

/// The allowed error of segment starts, in the unit frame: the spare part of `box_padding`, plus
/// the error that the scene was built for.
[[nodiscard]] double start_reach(const ReferenceScene::Implementation& reference);

/// Decides for up to sixteen starts whether all segments to the light are free, or all are crossed
/// by one triangle or by two that form a seam; `indeterminate` if neither is proven.
///
/// @param starts  their boxes meet their planes and reach at most `start_reach`; the light is not
///                in any of the planes.
[[nodiscard]] PacketOf<HypothesisVerdict>
trace_rounded_segments(const ReferenceScene::Implementation& reference, const SegmentLight& light,
                       std::span<const RoundedStart> starts, SignCounts& counts);

} // namespace gnomon::reference_rt
