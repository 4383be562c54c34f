#include "reference_rt/double_predicates.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

using scene::Light;
using scene::LightType;
using scene::Ray;
using scene::Vec2d;
using scene::Vec3d;

namespace {

/// 10u, u = 2^-53: covers the γ8 with which n·(x − y) is computed (difference 1, n 4, dot 8).
constexpr double plane_error = 10 * 0x1p-53;

Sign sign_of(double value)
{
    return static_cast<Sign>(value > 0) - static_cast<Sign>(value < 0);
}

bool precedes(const Vec3d& u, const Vec3d& v)
{
    return u.x != v.x ? u.x < v.x : (u.y != v.y ? u.y < v.y : u.z < v.z);
}

/// δ(E − o) + νd, which is δ(P − o).
Vec3d scaled_offset(const Receiver& receiver, const Vec3d& o)
{
    return receiver.delta * (receiver.ray.origin - o) + receiver.nu * receiver.ray.direction;
}

/// Side of P from the plane that holds the edge (u, v) and the direction `to_light`. Evaluated from
/// the edge's lower end, so that the edge (v, u) gives the opposite to the last bit.
Sign directional_edge_side(const Receiver& receiver, const Vec3d& u, const Vec3d& v,
                           const Vec3d& to_light)
{
    if (precedes(v, u)) {
        return -directional_edge_side(receiver, v, u, to_light);
    }
    return sign_of(glm::dot(glm::cross(u - v, to_light), scaled_offset(receiver, u)));
}

Vec3d to_light(const Receiver& receiver, const Light& light)
{
    return light.type == LightType::directional ? -light.direction
                                                : light.position - receiver.point();
}

/// Twice the signed area of (a, b, c).
double area2(const Vec2d& a, const Vec2d& b, const Vec2d& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Drops the coordinate along which the normal is longest.
Vec2d flatten(const Vec3d& point, const Vec3d& normal)
{
    const Vec3d n = glm::abs(normal);
    if (n.x >= n.y && n.x >= n.z) {
        return {point.y, point.z};
    }
    return n.y >= n.z ? Vec2d{point.z, point.x} : Vec2d{point.x, point.y};
}

} // namespace

std::optional<CameraHit> camera_hit(const Ray& ray, const Corners& corners)
{
    const Vec3d u = corners[0] - ray.origin;
    const Vec3d v = corners[1] - ray.origin;
    const Vec3d w = corners[2] - ray.origin;
    const auto [lowest, highest] =
        std::minmax({sign_of(glm::dot(glm::cross(u, v), ray.direction)),
                     sign_of(glm::dot(glm::cross(v, w), ray.direction)),
                     sign_of(glm::dot(glm::cross(w, u), ray.direction))});
    const Receiver hit = make_receiver(0, corners, ray);
    if ((lowest < 0 && highest > 0) || hit.delta == 0) {
        return std::nullopt;
    }
    const double t = hit.nu / hit.delta;
    const double nu_permanent = glm::dot(hit.normal_permanent, glm::abs(u));
    const double delta_permanent = glm::dot(hit.normal_permanent, glm::abs(ray.direction));
    return CameraHit{t, plane_error * (nu_permanent + std::abs(t) * delta_permanent) /
                            std::abs(hit.delta)};
}

bool is_attached(const Receiver& receiver, const Light& light)
{
    // The camera is in front of the pixel's own surface, t > 0: n·(E − a) = −ν.
    const Sign camera = -sign_of(receiver.nu);
    const Sign lamp = light.type == LightType::directional
                          ? -sign_of(glm::dot(receiver.normal, light.direction))
                          : sign_of(glm::dot(receiver.normal, light.position - receiver.corner));
    return lamp == 0 || lamp != camera;
}

bool is_out_of_light(const Receiver& receiver, const Light& light)
{
    if (light.type == LightType::directional) {
        return false;
    }
    const Vec3d from_light = receiver.point() - light.position;
    const double along = glm::dot(from_light, light.direction);
    const double cosine = light.cos_half_cone;
    const bool is_inside =
        along > 0 && along * along >= cosine * cosine * glm::dot(from_light, from_light) *
                                          glm::dot(light.direction, light.direction);
    return !is_inside;
}

bool is_coplanar(const Receiver& receiver, const Corners& s)
{
    return std::ranges::all_of(s, [&](const Vec3d& corner) {
        const Vec3d offset = corner - receiver.corner;
        const double permanent = glm::dot(receiver.normal_permanent, glm::abs(offset));
        return std::abs(glm::dot(receiver.normal, offset)) <= plane_error * permanent;
    });
}

ShadowSigns shadow_signs(const Receiver& receiver, const Corners& s, const Light& light)
{
    const auto& [u, v, w] = s;
    const Sign delta = sign_of(receiver.delta);
    const Vec3d normal = glm::cross(v - u, w - u);
    ShadowSigns signs;
    if (light.type == LightType::directional) {
        const Vec3d to_sun = -light.direction;
        signs.edge = {delta * directional_edge_side(receiver, u, v, to_sun),
                      delta * directional_edge_side(receiver, v, w, to_sun),
                      delta * directional_edge_side(receiver, w, u, to_sun)};
        signs.light = sign_of(glm::dot(normal, to_sun));
    } else {
        const Vec3d p = scaled_offset(receiver, light.position);
        const Vec3d lu = u - light.position;
        const Vec3d lv = v - light.position;
        const Vec3d lw = w - light.position;
        signs.edge = {delta * sign_of(glm::dot(glm::cross(lu, lv), p)),
                      delta * sign_of(glm::dot(glm::cross(lv, lw), p)),
                      delta * sign_of(glm::dot(glm::cross(lw, lu), p))};
        signs.light = sign_of(glm::dot(normal, light.position - u));
    }
    // P lies in the plane of T by definition: rounding must not lift it out of a plane that S
    // shares.
    signs.point = is_coplanar(receiver, s)
                      ? 0
                      : delta * sign_of(glm::dot(normal, scaled_offset(receiver, u)));
    return signs;
}

Sign apex_side(const Light& light, const Vec3d& u, const Vec3d& v, const Vec3d& apex)
{
    if (light.type == LightType::directional) {
        return sign_of(glm::dot(glm::cross(v - u, light.direction), apex - u));
    }
    return sign_of(
        glm::dot(glm::cross(u - light.position, v - light.position), apex - light.position));
}

bool runs_through(const Receiver& receiver, const Corners& s, const Light& light)
{
    const Vec3d normal = glm::cross(s[1] - s[0], s[2] - s[0]);
    const Vec2d point = flatten(receiver.point(), normal);
    const Vec2d step = flatten(to_light(receiver, light), normal);
    const std::array<Vec2d, 3> corner{flatten(s[0], normal), flatten(s[1], normal),
                                      flatten(s[2], normal)};
    const double turn = area2(corner[0], corner[1], corner[2]) > 0 ? 1 : -1;
    // Clips the segment point + r·step by the three half-planes that the triangle fills.
    const double end =
        light.type == LightType::directional ? std::numeric_limits<double>::infinity() : 1;
    double enter = 0;
    double leave = end;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2d& from = corner[i];
        const Vec2d& to = corner[(i + 1) % 3];
        const double inside = turn * area2(from, to, point);
        const double growth = turn * area2(from, to, point + step) - inside;
        if (growth > 0) {
            enter = std::max(enter, -inside / growth);
        } else if (growth < 0) {
            leave = std::min(leave, -inside / growth);
        } else if (inside < 0) {
            return false;
        }
    }
    return enter <= leave && leave > 0 && enter < end;
}

} // namespace gnomon::reference_rt
