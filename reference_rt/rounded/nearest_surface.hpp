#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/traversal/embree_scene.hpp"
#include "scene/pixels/rounded_receivers.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <exception>
#include <vector>

namespace gnomon::reference_rt {

/// The distance from a point to a closed triangle [m], in double precision.
/// Source: Ericson, Real-Time Collision Detection, 5.1.5.
[[nodiscard]] double distance_m(const scene::Vec3d& point, const Corners& triangle);

/// The barycentric coordinates (u, v) of the point of a closed triangle nearest to a point: of
/// a + u(b − a) + v(c − a), rounded, from 0, and u + v at most 1.
/// Source: Ericson, Real-Time Collision Detection, 5.1.5.
[[nodiscard]] scene::Vec2d nearest_place(const scene::Vec3d& point, const Corners& triangle);

/// A triangle and how far away it is.
struct NearbyTriangle {
    std::uint32_t triangle = scene::no_triangle;
    double distance_m = 0;
};

/// Finds the receiving triangles near a point: the nearest, and whatever may matter beside it.
class NearbySurfaces {
public:
    /// Both must outlive the search. Not for two threads at once.
    explicit NearbySurfaces(const ReferenceScene::Implementation& reference);

    /// The nearest triangle; of several at the same distance the lowest index. `no_triangle` where
    /// the scope holds none, not farther away than it says.
    ///
    /// Fastest where the point asked for before was near.
    [[nodiscard]] scene::NearestSurface find_nearest(const scene::Vec3d& point,
                                                     const scene::SurfaceScope& scope);
    /// Every triangle not farther than `extent_m` + √3·(the distance of the nearest), in order of
    /// index; none where the nearest is farther away than the scope says.
    [[nodiscard]] const std::vector<NearbyTriangle>&
    find_all(const scene::Vec3d& point, double extent_m, const scene::SurfaceScope& scope);

private:
    static bool visit(RTCPointQueryFunctionArguments* arguments) noexcept;

    void search(const scene::Vec3d& point, const scene::SurfaceScope& scope);
    /// Takes a triangle in, and narrows the search.
    void consider(std::uint32_t triangle);
    [[nodiscard]] double reach_m() const;
    [[nodiscard]] bool is_near_enough() const;
    /// Of the search that is left, in the unit frame.
    [[nodiscard]] float search_radius() const;
    [[nodiscard]] bool is_in_scope(std::uint32_t triangle) const;

    const ReferenceScene::Implementation& reference_;
    std::uint32_t hint_ = scene::no_triangle; ///< the nearest of the point asked for before
    scene::Vec3d point_{};
    double extent_m_ = 0;
    double spread_ = 1; ///< how many times the nearest distance is searched
    bool gathers_ = false;
    scene::SurfaceScope scope_;
    scene::NearestSurface nearest_;
    std::vector<NearbyTriangle> found_;
    std::exception_ptr failure_; ///< waits until Embree is left
};

} // namespace gnomon::reference_rt
