#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/pixels/receiver_raster.hpp"
#include "reference_rt/pixels/tiles.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "reference_rt/traversal/float_line_filter.hpp"
#include "reference_rt/traversal/packet.hpp"
#include "renderers/values.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <vector>

namespace gnomon::reference_rt {

/// Class and reason of a pixel in which GL's triangle is not a first hit.
struct UnmatchedVerdict {
    scene::PixelClass pixel_class = scene::PixelClass::background;
    scene::ClassReason reason = scene::ClassReason::none;
};

/// Compares GL's triangles with T*: the closed triangles that a pixel's ray meets first beyond the
/// near plane.
class FirstHits {
public:
    FirstHits(const ReferenceScene::Implementation& reference, const scene::View& view,
              const renderers::RasterFacts& facts);

    /// The lanes in which GL is right: its triangle is in T*, or it saw none and T* is empty.
    /// @param points  P of each lane in `tile.seen`, from `find_unit_points`.
    [[nodiscard]] LaneBits match(const Tile& tile, const LanePositions& points,
                                 SignCounts& counts) const;

    /// Class and reason of a pixel that `match` does not return: `background` if neither GL nor the
    /// ray meets a triangle, else `unmatched`.
    [[nodiscard]] UnmatchedVerdict explain(const CameraRay& ray, int x, int y,
                                           std::uint32_t triangle, SignCounts& counts) const;

    /// T*, in no particular order.
    [[nodiscard]] std::vector<std::uint32_t> first_hits(const CameraRay& ray,
                                                        SignCounts& counts) const;

private:
    const ReferenceScene::Implementation& reference_;
    double near_m_;
    RayBundle ray_bundle_;
    bool has_eye_; ///< whether all rays share one origin
    ReceiverRaster raster_;
};

} // namespace gnomon::reference_rt
