#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstddef>
#include <span>

/// Where a point was before it was rounded to float32.
namespace gnomon::reference_rt {

/// A box with exact corners [m].
struct RoundingBox {
    scene::Vec3d lower;
    scene::Vec3d upper;

    /// No corner is farther than this from `point`, a point of the box, in any component.
    [[nodiscard]] double reach_m(const scene::Vec3d& point) const;
    /// Corner 0 to 7; bit k says whether it is upper in component k.
    [[nodiscard]] scene::Vec3d corner(unsigned index) const;
};

/// All that rounds to p: half of float32's spacing above |p| on each side, which below a power of
/// two is a little more than that. Halves are no smaller than 2^-96.
/// @param growth_m  by how much each side is moved outwards; finite, >= 0.
[[nodiscard]] RoundingBox rounding_box(const scene::Vec3f& p, double growth_m);

/// True when the plane of a triangle meets a closed box: the signs of two corners decide.
[[nodiscard]] bool meets_plane(const RoundingBox& box, const ExactTriangle& face,
                               SignCounts& counts);

/// By how much the box of all that rounds to p is grown on each side until it meets the plane of a
/// triangle [m]; 0 where it does: (|n·(P − a)| − Σ|n_k|h_k) / Σ|n_k|, and not more than rounding
/// needs beyond that.
[[nodiscard]] double growth_to_plane_m(const scene::Vec3f& p, const ExactTriangle& face,
                                       SignCounts& counts);

/// The corners of the polygon in which a triangle's plane cuts a box; some twice, none where it
/// misses the box. Each is the point where an edge of the box meets the plane: a receiver, of which
/// everything can be decided exactly.
class PlaneSection {
public:
    /// `face` must outlive the section.
    PlaneSection(const RoundingBox& box, const ExactTriangle& face, SignCounts& counts);
    PlaneSection(const PlaneSection&) = delete;
    PlaneSection& operator=(const PlaneSection&) = delete;

    [[nodiscard]] std::span<const Receiver> corners() const { return {corners_.data(), count_}; }
    [[nodiscard]] bool empty() const { return count_ == 0; }

private:
    std::size_t count_ = 0;
    std::array<CameraRay, 12> edges_; ///< of the box
    std::array<Receiver, 12> corners_;
};

} // namespace gnomon::reference_rt
