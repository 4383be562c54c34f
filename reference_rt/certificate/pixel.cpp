#include "reference_rt/certificate/pixel.hpp"

#include "scene/camera/camera.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gnomon::reference_rt::certificate {

using scene::ClassReason;
using scene::no_triangle;
using scene::PixelClass;

namespace {

char symbol(Sign sign)
{
    return sign > 0 ? '+' : (sign < 0 ? '-' : '0');
}

std::string signs_text(const ContactSigns& signs)
{
    return fmt::format("(signs: edges {}{}{}, P {}, light {})", symbol(signs.edge[0]),
                       symbol(signs.edge[1]), symbol(signs.edge[2]), symbol(signs.point),
                       symbol(signs.light));
}

std::string explain_unmatched(const Finding& finding)
{
    return finding.triangle == no_triangle
               ? std::string{"the exact ray sees no surface"}
               : fmt::format("the exact ray sees triangle {} first", finding.triangle);
}

std::string explain_contact(const Finding& finding)
{
    const auto text = [&](std::string_view what) {
        return fmt::format("triangle {} {} {}", finding.triangle, what, signs_text(finding.signs));
    };
    if (finding.reason == ClassReason::vertex) {
        return text("is met exactly at a corner");
    }
    return text(finding.reason == ClassReason::silhouette
                    ? "is met exactly at an edge that is no seam"
                    : "is met in its plane");
}

std::string explain_blocked(const Finding& finding)
{
    return finding.partner == no_triangle
               ? fmt::format("triangle {} crosses the segment to the light {}", finding.triangle,
                             signs_text(finding.signs))
               : fmt::format("the seam of triangles {} and {} crosses the segment to the light {}",
                             finding.triangle, finding.partner, signs_text(finding.signs));
}

/// An error bound of the double P = E + (ν/δ)d along each axis, doubled for safety.
///
/// With u = 2^-53, N_i = |p_j q_k| + |p_k q_j| of the edges p and q, and Π_ν = Σ N_i |a_i − E_i|,
/// Π_δ = Σ N_i |d_i|: ν rounds at most eight times on each path and δ seven, t = ν/δ once more, the
/// product with d and the sum once each. So the error of t is at most u(10 Π_ν + 10 |t| Π_δ)/|δ| if
/// δ keeps at least half its size; empty if it may not.
std::optional<scene::Vec3d> double_error(const scene::Ray& ray,
                                         const std::array<scene::Vec3f, 3>& corners)
{
    constexpr double u = 0x1p-53;
    const scene::Vec3d a{corners[0]};
    const scene::Vec3d p = scene::Vec3d{corners[1]} - a;
    const scene::Vec3d q = scene::Vec3d{corners[2]} - a;
    const scene::Vec3d normal = glm::cross(p, q);
    scene::Vec3d size;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        size[i] = std::abs(p[j] * q[k]) + std::abs(p[k] * q[j]);
    }
    const double nu_size = glm::dot(size, glm::abs(a - ray.origin));
    const double delta_size = glm::dot(size, glm::abs(ray.direction));
    const double delta = std::abs(glm::dot(normal, ray.direction));
    if (!(delta > 40 * u * delta_size)) {
        return std::nullopt;
    }
    const double t = std::abs(glm::dot(normal, a - ray.origin)) / delta;
    const double t_error = u * (10 * nu_size + 10 * t * delta_size) / delta + 2 * u * t;
    const scene::Vec3d moved = glm::abs(ray.direction) * (t_error + u * t);
    return scene::Vec3d{2.0 * (moved + u * (glm::abs(ray.origin) + glm::abs(ray.direction) * t))};
}

/// Of several contacts, the first in this list names the pixel's reason.
int rank(ClassReason reason)
{
    constexpr std::array order{ClassReason::vertex, ClassReason::silhouette, ClassReason::graze};
    return static_cast<int>(std::ranges::find(order, reason) - order.begin());
}

} // namespace

std::string explain(const Finding& finding)
{
    switch (finding.pixel_class) {
    case PixelClass::background:
        return "neither GL nor the exact ray sees a surface";
    case PixelClass::unmatched:
        return explain_unmatched(finding);
    case PixelClass::attached:
        return fmt::format("the light is behind, or in the plane of, the side of triangle {} that "
                           "the camera sees",
                           finding.triangle);
    case PixelClass::out_of_light:
        return "P is outside the light's cone";
    case PixelClass::blocked:
        return explain_blocked(finding);
    case PixelClass::indeterminate:
        return explain_contact(finding);
    case PixelClass::lit:
        break;
    }
    return "nothing meets the segment to the light";
}

BruteForce::BruteForce(const scene::TriangleScene& scene, const scene::View& view)
    : scene_{scene},
      view_{view},
      casting_{scene::casting_ranges(scene)},
      receivers_{scene, scene::receiving_ranges(scene)},
      casters_{scene, casting_},
      light_{light_point(view.light)},
      near_{Rational{scene::receiver_near_m(scene.bounds())}}
{
}

Triangle BruteForce::triangle(std::uint32_t index) const
{
    return exact_triangle(scene_.corners(index));
}

bool BruteForce::is_triangle(std::uint32_t index) const
{
    return index < scene_.triangles.size();
}

CameraRay BruteForce::ray(int x, int y) const
{
    return CameraRay{scene::pixel_ray(view_.camera, view_.image, x, y)};
}

BruteForce::FirstHits BruteForce::first_hits(const CameraRay& ray) const
{
    FirstHits first;
    for (const std::uint32_t candidate :
         receivers_.candidates(Point{ray.origin}, Point{ray.direction, Rational{}})) {
        const auto t = hit_parameter(ray, triangle(candidate));
        if (!t || compare(*t, near_) <= 0) {
            continue;
        }
        const Sign order = first.triangles.empty() ? -1 : compare(*t, first.t);
        if (order < 0) {
            first = {{}, *t};
        }
        if (order <= 0) {
            first.triangles.push_back(candidate);
        }
    }
    return first;
}

Finding BruteForce::decide(int x, int y, std::uint32_t receiver) const
{
    const CameraRay camera = ray(x, y);
    const auto [first, t] = first_hits(camera);
    if (first.empty() && receiver == no_triangle) {
        return {PixelClass::background};
    }
    if (!std::ranges::binary_search(first, receiver)) {
        return {PixelClass::unmatched, ClassReason::none, first.empty() ? no_triangle : first[0]};
    }
    const Triangle seen = triangle(receiver);
    if (faces_away(camera, light_, seen)) {
        return {PixelClass::attached, ClassReason::none, receiver};
    }
    const Point p = point_at(camera, t);
    if (view_.light.has_cone() && !is_in_cone(p, view_.light)) {
        return {PixelClass::out_of_light, ClassReason::none, receiver};
    }
    return decide_segment(p, receiver);
}

Finding BruteForce::decide_segment(const Point& p, std::uint32_t receiver) const
{
    Finding result{PixelClass::lit};
    for (const std::uint32_t candidate : casters_.candidates(p, light_)) {
        if (candidate == receiver) {
            continue; // the segment meets its own plane only at P
        }
        const auto found = contact(p, candidate);
        if (!found) {
            continue;
        }
        if (scene::is_blocked(found->pixel_class)) {
            return *found;
        }
        if (scene::is_lit(result.pixel_class) || rank(found->reason) < rank(result.reason)) {
            result = *found;
        }
    }
    return result;
}

std::optional<Finding> BruteForce::contact(const Point& p, std::uint32_t candidate) const
{
    const Triangle corners = triangle(candidate);
    const ContactSigns signs = contact_signs(p, light_, corners);
    const auto touch = [&](ClassReason reason) {
        return Finding{PixelClass::indeterminate, reason, candidate, no_triangle, signs};
    };
    switch (contact_kind(signs)) {
    case ContactKind::none:
        break;
    case ContactKind::crossing:
        return Finding{PixelClass::blocked, ClassReason::none, candidate, no_triangle, signs};
    case ContactKind::through_edge: {
        const auto edge =
            static_cast<std::size_t>(std::ranges::find(signs.edge, 0) - signs.edge.begin());
        const std::uint32_t partner = seam_partner(candidate, edge);
        if (partner == no_triangle) {
            return touch(ClassReason::silhouette);
        }
        return Finding{PixelClass::blocked, ClassReason::none, candidate, partner, signs};
    }
    case ContactKind::through_corner:
        return touch(ClassReason::vertex);
    case ContactKind::in_plane:
        if (meets_in_plane(p, light_, corners)) {
            return touch(ClassReason::graze);
        }
        break;
    }
    return std::nullopt;
}

std::uint32_t BruteForce::seam_partner(std::uint32_t index, std::size_t edge) const
{
    const auto own = scene_.corners(index);
    const scene::Vec3f& u = own[edge];
    const scene::Vec3f& v = own[(edge + 1) % 3];
    const auto apex_side = [&](const scene::Vec3f& apex) {
        return orientation(Vector{scene::Vec3d{u}}, Vector{scene::Vec3d{v}}, light_,
                           Point{Vector{scene::Vec3d{apex}}});
    };
    const Sign own_side = apex_side(own[(edge + 2) % 3]);
    // Takes the highest index, so that a seam's lower triangle finds a partner above itself.
    std::uint32_t partner = no_triangle;
    for (const scene::TriangleRange& range : casting_) {
        for (std::uint32_t other = range.first; other < range.first + range.count; ++other) {
            const auto corners = scene_.corners(other);
            for (std::size_t i = 0; i < 3; ++i) {
                const scene::Vec3f& from = corners[i];
                const scene::Vec3f& to = corners[(i + 1) % 3];
                const bool is_shared = (from == u && to == v) || (from == v && to == u);
                if (is_shared && own_side * apex_side(corners[(i + 2) % 3]) < 0) {
                    partner = other;
                }
            }
        }
    }
    return partner;
}

WitnessVerdict BruteForce::check_witness(int x, int y, std::uint32_t receiver,
                                         std::uint32_t witness) const
{
    if (!is_triangle(receiver) || !is_triangle(witness)) {
        return {fmt::format("triangle {} or witness {} is none of the scene's {}", receiver,
                            witness, scene_.triangles.size())};
    }
    if (witness == receiver || !scene_.objects[scene_.object_of(witness)].casts) {
        return {fmt::format("witness {} is the receiver itself, or casts no shadow", witness)};
    }
    const CameraRay camera = ray(x, y);
    const Triangle seen = triangle(receiver);
    const auto t = plane_parameter(camera, seen);
    if (!t || compare(*t, near_) <= 0) {
        return {fmt::format("the pixel's ray does not meet the plane of triangle {}", receiver)};
    }
    const Point p = point_at(camera, *t);
    if (faces_away(camera, light_, seen) ||
        (view_.light.has_cone() && !is_in_cone(p, view_.light))) {
        return {fmt::format("triangle {} receives no light there", receiver)};
    }
    const auto found = contact(p, witness);
    if (!found || !scene::is_blocked(found->pixel_class)) {
        return {fmt::format("witness {} does not block {}", witness,
                            signs_text(contact_signs(p, light_, triangle(witness))))};
    }
    const bool is_seam = found->partner != no_triangle;
    if (is_seam && found->partner < witness) {
        return {fmt::format("witness {} is the upper triangle of its seam with {}", witness,
                            found->partner)};
    }
    return {{}, is_seam};
}

std::string BruteForce::check_position(int x, int y, std::uint32_t receiver,
                                       const scene::Vec3f& position) const
{
    if (!is_triangle(receiver)) {
        return fmt::format("triangle {} is none of the scene's {}", receiver,
                           scene_.triangles.size());
    }
    const scene::Ray sight = scene::pixel_ray(view_.camera, view_.image, x, y);
    const CameraRay camera{sight};
    const auto t = plane_parameter(camera, triangle(receiver));
    const auto error = double_error(sight, scene_.corners(receiver));
    if (!t || !error) {
        return {}; // nearly parallel: doubles do not resolve P
    }
    const Point p = point_at(camera, *t);
    const std::array<const Rational*, 3> exact{&p.vector.x, &p.vector.y, &p.vector.z};
    for (int axis = 0; axis < 3; ++axis) {
        const double claimed{position[axis]};
        const double nearest =
            exact[static_cast<std::size_t>(axis)]->rounded() / p.weight.rounded();
        // Half a float32 step: relative 2^-24, or half the smallest subnormal.
        const double radius =
            (*error)[axis] + 0x1p-24 * (std::abs(nearest) + (*error)[axis]) + 0x1p-149;
        if (!std::isfinite(claimed) ||
            !is_within(*exact[static_cast<std::size_t>(axis)], p.weight, claimed, radius)) {
            return fmt::format("its P.{} is {} and not {}", "XYZ"[axis], position[axis],
                               static_cast<float>(nearest));
        }
    }
    return {};
}

} // namespace gnomon::reference_rt::certificate
