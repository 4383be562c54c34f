#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "scene/pixels/rounded_receivers.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <exception>
#include <vector>

namespace gnomon::reference_rt {

/// The distance of a point from a closed triangle [m], in double precision.
/// Source: Ericson, Real-Time Collision Detection, 5.1.5.
[[nodiscard]] double distance_m(const scene::Vec3d& point, const Corners& triangle);

/// The barycentric coordinates (u, v) of the point nearest to `point` on a closed triangle, a + u(b
/// − a) + v(c − a), rounded; u, v >= 0 and u + v <= 1.
/// Source: Ericson, Real-Time Collision Detection, 5.1.5.
[[nodiscard]] scene::Vec2d nearest_place(const scene::Vec3d& point, const Corners& triangle);

/// A triangle and its distance.
struct NearbyTriangle {
    std::uint32_t triangle = scene::no_triangle;
    double distance_m = 0;
};

/// Finds the receiving triangles near a point.
class NearbySurfaces {
public:
    /// The reference must outlive this object. Not thread-safe.
    explicit NearbySurfaces(const ReferenceScene::Implementation& reference);

    /// The nearest triangle, with ties going to the lowest index; `no_triangle` if the scope has
    /// none within its distance.
    ///
    /// Fastest if the previous point was near.
    [[nodiscard]] scene::NearestSurface find_nearest(const scene::Vec3d& point,
                                                     const scene::SurfaceScope& scope);
    /// Every triangle within `extent_m` + √3·(distance of the nearest), ordered by index; empty if
    /// the nearest is beyond the scope's distance.
    [[nodiscard]] const std::vector<NearbyTriangle>&
    find_all(const scene::Vec3d& point, double extent_m, const scene::SurfaceScope& scope);

private:
    static bool visit(RTCPointQueryFunctionArguments* arguments) noexcept;

    void search(const scene::Vec3d& point, const scene::SurfaceScope& scope);
    /// Records a triangle and narrows the search.
    void consider(std::uint32_t triangle);
    [[nodiscard]] double reach_m() const;
    [[nodiscard]] bool is_near_enough() const;
    /// The remaining search radius, in the unit frame.
    [[nodiscard]] float search_radius() const;
    [[nodiscard]] bool is_in_scope(std::uint32_t triangle) const;

    const ReferenceScene::Implementation& reference_;
    std::uint32_t hint_ = scene::no_triangle; ///< the nearest triangle of the previous point
    scene::Vec3d point_{};
    double extent_m_ = 0;
    double spread_ = 1; ///< search radius as a multiple of the nearest distance
    bool gathers_ = false;
    scene::SurfaceScope scope_;
    scene::NearestSurface nearest_;
    std::vector<NearbyTriangle> found_;
    std::exception_ptr failure_; ///< rethrown after Embree returns
};

} // namespace gnomon::reference_rt
