#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <array>
#include <cstdint>

namespace gnomon::reference_rt {

/// −1, 0 or 1.
using Sign = int;

/// The five signs that decide how a triangle S = (u, v, w) meets the open segment P→light.
struct ShadowSigns {
    std::array<Sign, 3> edge; ///< side of P of the planes through the light and (u,v), (v,w), (w,u)
    Sign point = 0;           ///< side of P of the plane of S
    Sign light = 0;           ///< side of the light of the plane of S
};

/// How a triangle meets the open segment P→light.
enum class Contact : std::uint8_t {
    none,
    cross,  ///< properly through its interior
    edge,   ///< exactly through one edge
    vertex, ///< exactly through one vertex
    plane,  ///< the segment lies in its plane and may meet the triangle
};

/// Classifies a contact by its signs. Meeting only at P or at the light is no contact.
[[nodiscard]] Contact classify_contact(const ShadowSigns& signs);

/// Index of the edge whose sign is zero. Precondition: the contact is `edge`.
[[nodiscard]] int touched_edge(const ShadowSigns& signs);

/// Whether two triangles with a common edge lie on opposite sides of the plane through that edge
/// and the light, so that a segment which meets the edge passes through their surface.
///
/// @param apex_a, apex_b  sides of the triangles' third corners of that plane.
[[nodiscard]] constexpr bool is_seam(Sign apex_a, Sign apex_b)
{
    return apex_a * apex_b < 0;
}

/// The contacts found on one segment.
struct SegmentContacts {
    std::uint32_t witness =
        scene::no_triangle;    ///< a blocking triangle (for a seam the lower index)
    bool touches_edge = false; ///< an edge contact without a seam
    bool touches_vertex = false;
    bool runs_in_triangle = false; ///< lies in a triangle's plane and runs through it
};

struct Shadowing {
    scene::PixelClass pixel_class = scene::PixelClass::lit;
    scene::ClassReason reason = scene::ClassReason::none;
};

/// Blocked if there is a witness; else indeterminate, with the first applicable reason of vertex,
/// silhouette, graze; else lit. Independent of the order of contacts.
[[nodiscard]] Shadowing classify_segment(const SegmentContacts& contacts);

} // namespace gnomon::reference_rt
