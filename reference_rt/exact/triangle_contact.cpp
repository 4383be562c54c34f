#include "reference_rt/exact/triangle_contact.hpp"

#include <algorithm>

namespace gnomon::reference_rt {

TriangleContact find_contact(const Receiver& receiver, const SceneTriangle& s,
                             const scene::Light& light, SignCounts& counts)
{
    const Corners& corners = s.corners;
    ShadowSigns signs;
    for (std::size_t i = 0; i < 3; ++i) {
        signs.edge[i] = point_side(receiver, corners[i], corners[(i + 1) % 3], light, counts);
        if (i > 0 && signs.edge[i] * signs.edge[i - 1] < 0) {
            return {}; // all three are 0 if the segment runs in the plane
        }
    }
    signs.light = light_side(corners, light, counts);
    signs.point = point_sign(receiver, corners, counts);
    const Contact kind = classify_contact(signs);
    switch (kind) {
    case Contact::edge:
        return {kind, touched_edge(signs)};
    case Contact::plane:
        return {runs_through(receiver, corners, light) ? kind : Contact::none};
    case Contact::none:
    case Contact::cross:
    case Contact::vertex:
        break;
    }
    return {kind};
}

Passage find_passage(std::span<const Receiver> polygon, const SceneTriangle& s,
                     const scene::Light& light, SignCounts& counts)
{
    Passage passage;
    const Sign towards = light_side(s.corners, light, counts);
    bool is_on_lights_side = towards != 0; // or in the plane of S, meeting at P only
    bool is_never_in_plane = true;
    passage.is_between = towards != 0;
    passage.is_inside.fill(true);
    std::array<bool, 3> is_outside{true, true, true};
    for (const Receiver& corner : polygon) {
        const ShadowSigns signs = shadow_signs(corner, s.corners, light, counts);
        is_on_lights_side &= signs.point * towards >= 0;
        is_never_in_plane &= signs.point != 0;
        passage.is_between &= signs.point * towards < 0;
        for (std::size_t i = 0; i < 3; ++i) {
            // Lines from the light through the interior of S have all three edge signs equal to
            // −σ1.
            passage.is_inside[i] &= signs.edge[i] == -towards && towards != 0;
            is_outside[i] &= signs.edge[i] == towards && towards != 0;
        }
    }
    // If the light but no point lies in the plane of S, they meet at most at the light.
    const bool meets_at_light = towards == 0 && is_never_in_plane;
    passage.may_touch =
        !is_on_lights_side && !meets_at_light &&
        std::none_of(is_outside.begin(), is_outside.end(), [](bool b) { return b; });
    return passage;
}

TriangleContact hit_of(const CameraRay& ray, const SceneTriangle& s, SignCounts& counts)
{
    std::array<Sign, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) {
        side[i] = passing_side(ray, s.corners[i], s.corners[(i + 1) % 3], counts);
        if (i > 0 && side[i] * side[i - 1] < 0) {
            return {};
        }
    }
    // The three sum to δ; if all are zero, the line runs in the plane.
    switch (std::ranges::count(side, 0)) {
    case 0:
        return {Contact::cross};
    case 1: {
        const auto edge = static_cast<std::size_t>(std::ranges::find(side, 0) - side.begin());
        return side[(edge + 1) % 3] == side[(edge + 2) % 3]
                   ? TriangleContact{Contact::edge, static_cast<int>(edge)}
                   : TriangleContact{};
    }
    case 2:
        return {Contact::vertex};
    default:
        return {};
    }
}

} // namespace gnomon::reference_rt
