#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/pixels/shadow_segments.hpp"
#include "reference_rt/rounded/rounding_box.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::reference_rt {

/// One supposition: a pixel shows the triangle T, somewhere in its rounding box.
struct Hypothesis {
    std::size_t pixel = 0;
    std::uint32_t triangle = scene::no_triangle; ///< T
    double growth_m = 0;                         ///< of the box
};

/// What holds for every point of a supposition.
struct HypothesisVerdict {
    scene::PixelClass pixel_class = scene::PixelClass::indeterminate;
    std::uint32_t witness =
        scene::no_triangle; ///< of `blocked`: crosses the segments of all points
};

/// A supposition's geometry.
struct RoundedStart {
    ExactTriangle face; ///< T
    RoundingBox box{};
    scene::Vec3d point{}; ///< P, as it was rounded
};

/// How far the starts of segments may be off for the boxes that Embree traverses, in the unit
/// frame: what `box_padding` has to spare, and what the scene was built with beside it.
[[nodiscard]] double start_reach(const ReferenceScene::Implementation& reference);

/// Decides of up to sixteen starts whether all segments from them to the light are free, or all of
/// them crossed by one triangle, or by two that form a seam; `indeterminate` where neither is
/// shown.
///
/// @param starts  Their boxes meet their planes, and reach no farther than `start_reach`; the light
///                is on a side of each plane.
[[nodiscard]] PacketOf<HypothesisVerdict>
trace_rounded_segments(const ReferenceScene::Implementation& reference, const SegmentLight& light,
                       std::span<const RoundedStart> starts, SignCounts& counts);

} // namespace gnomon::reference_rt
