#include "reference_rt/exact/contact.hpp"

#include <algorithm>
#include <cassert>

namespace gnomon::reference_rt {

using scene::ClassReason;
using scene::PixelClass;

Contact classify_contact(const ShadowSigns& signs)
{
    if (signs.point == 0 && signs.light == 0) {
        return Contact::plane;
    }
    if (signs.point * signs.light >= 0) {
        return Contact::none; // both on one side, or only one of them in the plane
    }
    const auto [lowest, highest] = std::minmax({signs.edge[0], signs.edge[1], signs.edge[2]});
    if (lowest < 0 && highest > 0) {
        return Contact::none;
    }
    switch (std::ranges::count(signs.edge, 0)) {
    case 0:
        return Contact::cross;
    case 1:
        return Contact::edge;
    default:
        return Contact::vertex;
    }
}

int touched_edge(const ShadowSigns& signs)
{
    assert(classify_contact(signs) == Contact::edge);
    return static_cast<int>(std::ranges::find(signs.edge, 0) - signs.edge.begin());
}

Shadowing classify_segment(const SegmentContacts& contacts)
{
    if (contacts.witness != scene::no_triangle) {
        return {PixelClass::blocked, ClassReason::none};
    }
    if (contacts.touches_vertex) {
        return {PixelClass::indeterminate, ClassReason::vertex};
    }
    if (contacts.touches_edge) {
        return {PixelClass::indeterminate, ClassReason::silhouette};
    }
    if (contacts.runs_in_triangle) {
        return {PixelClass::indeterminate, ClassReason::graze};
    }
    return {PixelClass::lit, ClassReason::none};
}

} // namespace gnomon::reference_rt
