#include "reference_rt/light/texel_rays.hpp"

#include "reference_rt/traversal/unit_frame.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon::reference_rt {

using scene::Ray;
using scene::Vec3d;
using scene::Vec4d;

ClipRows::ClipRows(const scene::LightFrustum& frustum)
{
    const scene::Mat4f rows = glm::transpose(frustum.light_clip_from_world);
    x = Vec4d{rows[0]};
    y = Vec4d{rows[1]};
    z = Vec4d{rows[2]};
    w = Vec4d{rows[3]};
}

TexelRays::TexelRays(const scene::LightFrustum& frustum, const scene::Light& light,
                     int resolution_texels, const scene::Vec2d& place)
    : rows_{frustum},
      near_{frustum.reversed ? rows_.w - rows_.z : rows_.z + rows_.w},
      crosses_{Vec3d{rows_.x}, Vec3d{rows_.y}, Vec3d{near_}},
      forward_{frustum.forward},
      resolution_{resolution_texels},
      twice_place_{2.0 * place},
      light_{light}
{
    if (!has_positional()) {
        light_.direction = direction(rows_.x, rows_.y); // W·(point, 1) is 1 for all points
    }
}

TexelRays::Crosses::Crosses(const Vec3d& a, const Vec3d& b, const Vec3d& n)
    : b_near{glm::cross(b, n)},
      near_a{glm::cross(n, a)},
      a_b{glm::cross(a, b)},
      a_b_near{glm::dot(a, b_near)}
{
}

Vec3d TexelRays::direction(const Vec4d& a, const Vec4d& b) const
{
    const Vec3d across = glm::cross(Vec3d{a}, Vec3d{b});
    return normalised(glm::dot(across, forward_) < 0 ? -across : across);
}

Ray TexelRays::ray(scene::Texel texel) const
{
    const double u = (double(2 * texel.x - resolution_) + twice_place_.x) / resolution_;
    const double v = (double(2 * texel.y - resolution_) + twice_place_.y) / resolution_;
    const Vec4d a = rows_.x - u * rows_.w;
    const Vec4d b = rows_.y - v * rows_.w;
    if (has_positional()) {
        return {light_.position, direction(a, b)};
    }
    const auto& [b_near, near_a, a_b, a_b_near] = crosses_;
    const Vec3d sum = a.w * b_near + b.w * near_a + near_.w * a_b;
    return {-sum / a_b_near, light_.direction};
}

} // namespace gnomon::reference_rt
