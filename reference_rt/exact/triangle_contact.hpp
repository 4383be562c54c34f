#pragma once

#include "reference_rt/exact/contact.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/exact/receiver.hpp"
#include "scene/light/light.hpp"

#include <array>
#include <span>

/// Whether what traversal proposes is met: by a segment to the light, by all segments from a
/// polygon, by a ray. No other code accepts a triangle of the scene, but for float rays alone
/// (traversal/embree_scene.hpp) and the certificate.
namespace gnomon::reference_rt {

/// How a triangle is met.
struct TriangleContact {
    Contact kind = Contact::none;
    int edge = 0; ///< of the triangle, 0 for (u, v), where the kind is `edge`
};

/// How S meets the open segment from P to the light: its five signs (`shadow_signs`), as far as
/// they are needed. In its plane a segment meets it only if it runs through it.
[[nodiscard]] TriangleContact find_contact(const Receiver& receiver, const SceneTriangle& s,
                                           const scene::Light& light, SignCounts& counts);

/// How a triangle stands to the segments from all points of a polygon to the light.
struct Passage {
    bool may_touch = false;          ///< not shown to be apart from all of them
    bool is_between = false;         ///< its plane certainly is, for all points
    std::array<bool, 3> is_inside{}; ///< by edge: all lines to the light certainly pass inside

    [[nodiscard]] bool crosses_all() const
    {
        return is_between && is_inside[0] && is_inside[1] && is_inside[2];
    }
    /// But for one edge.
    [[nodiscard]] bool crosses_all_beside(std::size_t edge) const
    {
        return is_between && is_inside[(edge + 1) % 3] && is_inside[(edge + 2) % 3];
    }
};

/// All that the signs at a polygon's corners show of the whole polygon: each of the five is that of
/// a linear function of P, so that a strict sign at all corners is one everywhere between them.
[[nodiscard]] Passage find_passage(std::span<const Receiver> polygon, const SceneTriangle& s,
                                   const scene::Light& light, SignCounts& counts);

/// How the ray's line meets the closed triangle at one point: `cross`, `edge`, `vertex` or `none`,
/// as where it runs in the triangle's plane.
[[nodiscard]] TriangleContact hit_of(const CameraRay& ray, const SceneTriangle& s,
                                     SignCounts& counts);

} // namespace gnomon::reference_rt
