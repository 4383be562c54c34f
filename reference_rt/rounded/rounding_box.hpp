#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstddef>
#include <span>

/// The possible positions of a point before it was rounded to float32.
namespace gnomon::reference_rt {

/// A box with exact corners [m].
struct RoundingBox {
    scene::Vec3d lower;
    scene::Vec3d upper;

    /// The largest distance in any component between a corner and `point`, a point of the box.
    [[nodiscard]] double reach_m(const scene::Vec3d& point) const;
    /// Corner 0 to 7; bit k selects the upper bound in component k.
    [[nodiscard]] scene::Vec3d corner(unsigned index) const;
};

/// The points that round to p: half of float32's spacing above |p| on each side, which is slightly
/// too large below a power of two. Halves are at least 2^-96.
/// @param growth_m  how far each side moves outwards; finite, >= 0.
[[nodiscard]] RoundingBox rounding_box(const scene::Vec3f& p, double growth_m);

/// Whether a triangle's plane meets a closed box, by the signs of two corners.
[[nodiscard]] bool meets_plane(const RoundingBox& box, const ExactTriangle& face,
                               SignCounts& counts);

/// How far p's rounding box must grow on each side to meet a triangle's plane [m], at least 0:
/// (|n·(P − a)| − Σ|n_k|h_k) / Σ|n_k|, rounded up.
[[nodiscard]] double growth_to_plane_m(const scene::Vec3f& p, const ExactTriangle& face,
                                       SignCounts& counts);

/// The corners of the polygon in which a triangle's plane cuts a box; some may repeat, and there
/// are none if it misses. Each is where an edge of the box meets the plane, so it is a receiver for
/// exact predicates.
class PlaneSection {
public:
    /// `face` must outlive this object.
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
