#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/pixels/shadow_segments.hpp"
#include "reference_rt/traversal/unit_frame.hpp"
#include "scene/light/light.hpp"

#include <cstddef>

namespace gnomon::reference_rt {

/// Where the segments of given points begin in the unit frame, however far away the points are.
///
/// Embree's rays must begin near the scene (`farthest_origin`). A segment that begins farther away
/// is taken from where it comes near the scene; what lies before meets nothing.
class PointStarts {
public:
    /// Both must outlive this.
    PointStarts(const UnitFrame& frame, const scene::Light& light);

    /// Takes the lane in, unless its segment never comes near the scene.
    /// @param receiver  at a place of a triangle.
    void add(std::size_t lane, const Receiver& receiver, SegmentStarts& starts) const;

private:
    void add_far(std::size_t lane, const Receiver& receiver, const IntervalPoint& point,
                 SegmentStarts& starts) const;
    [[nodiscard]] IntervalPoint exact_start(const Receiver& receiver, double share) const;

    const UnitFrame& frame_;
    const scene::Light& light_;
    scene::Vec3d unit_light_{}; ///< position in the unit frame, or the way to a directional light
};

} // namespace gnomon::reference_rt
