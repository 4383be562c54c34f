#include "scene/light/map_choice.hpp"

#include "scene/light/cube_faces.hpp"

#include <algorithm>
#include <iterator>

namespace gnomon::scene {

namespace {

/// Whether −w <= x < w, as the coordinate on the map is rounded.
bool is_on_map(float x, float w)
{
    const float from_edge = x + w;
    return from_edge >= 0 && from_edge < 2 * w;
}

std::size_t first_that_contains(std::span<const LightFrustum> maps, const Vec3f& point)
{
    for (std::size_t i = 0; i + 1 < maps.size(); ++i) {
        if (contains(maps[i], clip_position(maps[i].light_clip_from_world, point))) {
            return i;
        }
    }
    return maps.size() - 1;
}

} // namespace

Vec4f clip_position(const Mat4f& clip_from_world, const Vec3f& point)
{
    Vec4f clip = clip_from_world[0] * point.x;
    clip = clip + clip_from_world[1] * point.y;
    clip = clip + clip_from_world[2] * point.z;
    return clip + clip_from_world[3];
}

bool contains(const LightFrustum& map, const Vec4f& clip)
{
    const float nearest = map.clip_range == ClipRange::zero_to_one ? 0 : -clip.w;
    return clip.w > 0 && is_on_map(clip.x, clip.w) && is_on_map(clip.y, clip.w) &&
           clip.z >= nearest && clip.z <= clip.w;
}

float ViewSlices::view_depth_m(const Vec3f& point) const
{
    const Vec3f from_eye = point - eye;
    const float across = forward.x * from_eye.x + forward.y * from_eye.y;
    return across + forward.z * from_eye.z;
}

std::size_t ViewSlices::slice_of(const Vec3f& point) const
{
    const float depth_m = view_depth_m(point);
    const auto end = std::ranges::find_if(ends, [&](float m) { return depth_m < m; });
    return std::min(static_cast<std::size_t>(std::distance(ends.begin(), end)), ends.size() - 1);
}

std::size_t chosen_map(std::span<const LightFrustum> maps, MapChoice choice,
                       const ViewSlices& slices, const Vec3f& point)
{
    switch (choice) {
    case MapChoice::containing:
        return first_that_contains(maps, point);
    case MapChoice::cube_face:
        return cube_face_towards(point - Vec3f{maps.front().origin});
    case MapChoice::view_depth:
        return slices.slice_of(point);
    }
    return 0;
}

} // namespace gnomon::scene
