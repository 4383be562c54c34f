#include "reference_rt/light/known_hits.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace gnomon::reference_rt {

using renderers::TexelHit;
using scene::LightFrustum;
using scene::no_triangle;
using scene::Ray;
using scene::Texel;
using scene::Vec3d;

namespace {

/// Whether the rays of a spot's texels are the same: they depend on nothing else of the frustum.
bool has_same_rays(const LightFrustum& a, const LightFrustum& b)
{
    const ClipRows rows_a{a};
    const ClipRows rows_b{b};
    return rows_a.x == rows_b.x && rows_a.y == rows_b.y && rows_a.w == rows_b.w &&
           a.forward == b.forward;
}

/// Whether they are the same, and the planes between which they see, whatever the light.
bool has_same_view(const LightFrustum& a, const LightFrustum& b)
{
    return a.light_clip_from_world == b.light_clip_from_world && a.reversed == b.reversed &&
           a.forward == b.forward;
}

/// Where a frustum begins along a ray from the light; nothing is known where it does not lie before
/// the ray, near plane first.
Interval near_parameter(const LightFrustum& frustum, const Ray& ray)
{
    const ClipLine line = LightDepth{frustum}.plainly_along(ray);
    // Depth is 0 (reversed: 1) where `near` is, and at the other end of its range where `far` is.
    const Interval near_start =
        frustum.reversed ? line.w_start - line.z_start : line.z_start + line.w_start;
    const Interval near_step =
        frustum.reversed ? line.w_step - line.z_step : line.z_step + line.w_step;
    const Interval far_step = frustum.reversed ? line.z_step : line.w_step - line.z_step;
    const bool is_before_the_ray = near_start.is_certainly_negative() &&
                                   near_step.is_certainly_positive() &&
                                   far_step.is_certainly_negative();
    return is_before_the_ray ? Interval{0, 0} - near_start / near_step
                             : Interval{0, std::numeric_limits<double>::infinity()};
}

/// The ray of a spot through a corner of the map.
Ray corner_ray(const LightFrustum& frustum, const scene::Light& light, double u, double v)
{
    const ClipRows rows{frustum};
    const Vec3d across = glm::cross(Vec3d{rows.x - u * rows.w}, Vec3d{rows.y - v * rows.w});
    return {light.position, glm::dot(across, frustum.forward) < 0 ? -across : across};
}

} // namespace

bool keeps_first_hits(const scene::Light& light, const LightFrustum& from, const LightFrustum& to)
{
    if (has_same_view(from, to)) {
        return true;
    }
    if (!light.has_position() || !has_same_rays(from, to)) {
        return false;
    }
    constexpr std::array<std::array<double, 2>, 4> corners{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    return std::ranges::all_of(corners, [&](const auto& corner) {
        const Ray ray = corner_ray(from, light, corner[0], corner[1]);
        return (near_parameter(to, ray) - near_parameter(from, ray)).is_certainly_positive();
    });
}

void KnownHitPlacer::place(std::span<const Texel> texels, std::span<const std::uint32_t> triangles,
                           std::span<TexelHit> hits) const
{
    assert(texels.size() == triangles.size() && texels.size() == hits.size());
    SignCounts counts;
    LightDepth::PlaceMemory memory;
    ExactTriangle face;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (triangles[i] == no_triangle) {
            continue;
        }
        if (triangles[i] != face.triangle) {
            face = {triangles_, triangles[i]};
        }
        const CameraRay ray{rays_.ray(texels[i])};
        const Receiver hit{face, ray, counts};
        const ClipLine line = depth_.plainly_along(ray.ray);
        if (depth_.is_in_range(line, hit, depth_.at(line, parameter_of(hit)))) {
            auto [depth, light_distance_m] = depth_.place(hit, memory);
            if (distance_ != nullptr) {
                depth = distance_->place(hit);
            }
            hits[i] = {triangles[i], depth.value, light_distance_m, depth.error};
        }
    }
}

} // namespace gnomon::reference_rt
