#pragma once

#include "reference_rt/exact/contact.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/exact/receiver.hpp"
#include "scene/light/light.hpp"

#include <array>
#include <span>

/// Decides whether a candidate triangle is met by a segment to the light, by all segments from a
/// polygon, or by a ray. Only float rays (traversal/embree_scene.hpp) and the certificate accept
/// triangles elsewhere.
namespace gnomon::reference_rt {

/// How a triangle is met.
struct TriangleContact {
    Contact kind = Contact::none;
    int edge = 0; ///< index of the edge if the kind is `edge`; 0 is (u, v)
};

/// How S meets the open segment from P to the light. Evaluates the five signs (`shadow_signs`)
/// lazily. A segment in the plane of S is a contact only if it runs through S.
[[nodiscard]] TriangleContact find_contact(const Receiver& receiver, const SceneTriangle& s,
                                           const scene::Light& light, SignCounts& counts);

/// How a triangle relates to the segments from all points of a polygon to the light.
struct Passage {
    bool may_touch = false;  ///< not proven apart from all segments
    bool is_between = false; ///< its plane certainly separates all points from the light
    std::array<bool, 3>
        is_inside{}; ///< by edge: whether all lines to the light certainly pass inside

    [[nodiscard]] bool crosses_all() const
    {
        return is_between && is_inside[0] && is_inside[1] && is_inside[2];
    }
    /// As `crosses_all`, ignoring one edge.
    [[nodiscard]] bool crosses_all_beside(std::size_t edge) const
    {
        return is_between && is_inside[(edge + 1) % 3] && is_inside[(edge + 2) % 3];
    }
};

/// The passage of a whole polygon, from the signs at its corners. Each of the five is the sign of a
/// linear function of P, so a strict sign at all corners holds in the whole polygon.
[[nodiscard]] Passage find_passage(std::span<const Receiver> polygon, const SceneTriangle& s,
                                   const scene::Light& light, SignCounts& counts);

/// How the ray's line meets the closed triangle: `cross`, `edge`, `vertex`, or `none`, also if it
/// runs in the triangle's plane.
[[nodiscard]] TriangleContact hit_of(const CameraRay& ray, const SceneTriangle& s,
                                     SignCounts& counts);

} // namespace gnomon::reference_rt
