#pragma once

#include "exact_oracle.hpp"
#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

/// Every pixel's shadowing by brute force in rationals, contacts and seams included.
namespace gnomon::reference_rt::test {

using Triangle = std::array<scene::Vec3f, 3>;
using Rational2 = std::array<Rational, 2>;

inline RationalVec exact(const scene::Vec3f& v)
{
    return RationalVec{Vec3d{v}};
}

inline Rational area(const Rational2& a, const Rational2& b, const Rational2& c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// True when the closed segments have a point in common.
inline bool cross_or_touch(const Rational2& a, const Rational2& b, const Rational2& c,
                           const Rational2& d)
{
    const auto within = [](const Rational2& p, const Rational2& q, const Rational2& x) {
        return area(p, q, x) == 0 && std::min(p[0], q[0]) <= x[0] && x[0] <= std::max(p[0], q[0]) &&
               std::min(p[1], q[1]) <= x[1] && x[1] <= std::max(p[1], q[1]);
    };
    const int c_side = area(a, b, c).sign();
    const int d_side = area(a, b, d).sign();
    const int a_side = area(c, d, a).sign();
    const int b_side = area(c, d, b).sign();
    return (c_side * d_side < 0 && a_side * b_side < 0) || within(a, b, c) || within(a, b, d) ||
           within(c, d, a) || within(c, d, b);
}

/// The segment P→light, cut where it has left the scene.
struct Segment {
    RationalVec from, step;
    bool is_directional;
};

/// True when the open segment lies in the triangle's plane and meets it there.
inline bool runs_in(const Segment& segment, const Triangle& t)
{
    const RationalVec a = exact(t[0]);
    const RationalVec n = cross(exact(t[1]) - a, exact(t[2]) - a);
    if (dot(n, segment.step) != 0 || dot(n, segment.from - a) != 0) {
        return false;
    }
    const auto flat = [&](const RationalVec& v) {
        return n.x != 0   ? Rational2{v.y, v.z}
               : n.y != 0 ? Rational2{v.z, v.x}
                          : Rational2{v.x, v.y};
    };
    // Less than any distance between different crossings of these scenes' edges: the ends are open.
    const Rational nearly_nothing{0x1p-300};
    const Rational reach =
        (segment.is_directional ? Rational{1 << 20} : Rational{1}) - nearly_nothing;
    const Rational2 p = flat(segment.from + nearly_nothing * segment.step);
    const Rational2 q = flat(segment.from + reach * segment.step);
    const std::array<Rational2, 3> c{flat(a), flat(exact(t[1])), flat(exact(t[2]))};
    for (std::size_t i = 0; i < 3; ++i) {
        if (cross_or_touch(p, q, c[i], c[(i + 1) % 3])) {
            return true;
        }
    }
    const int side = area(c[0], c[1], p).sign();
    return side == area(c[1], c[2], p).sign() && side == area(c[2], c[0], p).sign();
}

/// True when the segment's line meets the triangle at one of its corners.
inline bool is_at_vertex(const Segment& segment, const Triangle& t)
{
    const auto hit = hit_of(segment.from, segment.step, t);
    const int zeros =
        (hit->u == 0 ? 1 : 0) + (hit->v == 0 ? 1 : 0) + (hit->u + hit->v == 1 ? 1 : 0);
    return zeros == 2;
}

/// True when the triangles share an edge, by position, and lie on different sides of the plane
/// through it and the light.
inline bool is_exact_seam(const Triangle& a, const Triangle& b, const scene::Light& light)
{
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const auto& u = a[i];
            const auto& v = a[(i + 1) % 3];
            const bool is_shared =
                (b[j] == u && b[(j + 1) % 3] == v) || (b[j] == v && b[(j + 1) % 3] == u);
            if (!is_shared) {
                continue;
            }
            const RationalVec g = light.type == scene::LightType::directional
                                      ? RationalVec{-light.direction}
                                      : RationalVec{light.position} - exact(u);
            const RationalVec n = cross(exact(v) - exact(u), g);
            return dot(n, exact(a[(i + 2) % 3]) - exact(u)).sign() *
                       dot(n, exact(b[(j + 2) % 3]) - exact(u)).sign() <
                   0;
        }
    }
    return false;
}

/// Blocked, lit or indeterminate by trying every triangle.
inline PixelClass exact_shadowing(const TriangleScene& scene, const View& view,
                                  const RationalVec& point, std::uint32_t receiver)
{
    const bool is_directional = view.light.type == scene::LightType::directional;
    const Segment segment{point,
                          is_directional ? RationalVec{-view.light.direction}
                                         : RationalVec{view.light.position} - point,
                          is_directional};
    std::vector<Triangle> touched;
    bool touches_otherwise = false; // at a vertex, or inside its plane
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        if (t == receiver) {
            continue;
        }
        const Triangle triangle = scene.corners(t);
        const ExactContact contact = exact_contact(point, view.light, triangle);
        if (contact == ExactContact::cross) {
            return PixelClass::blocked;
        }
        if (contact == ExactContact::boundary && is_at_vertex(segment, triangle)) {
            touches_otherwise = true;
        } else if (contact == ExactContact::boundary) {
            touched.push_back(triangle);
        }
        touches_otherwise = touches_otherwise || runs_in(segment, triangle);
    }
    for (std::size_t i = 0; i < touched.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            // A vertex contact is none of an edge's interior: two triangles there need not be a
            // seam.
            if (is_exact_seam(touched[i], touched[j], view.light)) {
                return PixelClass::blocked;
            }
        }
    }
    return touched.empty() && !touches_otherwise ? PixelClass::lit : PixelClass::indeterminate;
}

/// True when the ray meets the closed triangle, and nothing before it beyond the near plane.
inline bool is_exact_first_hit(const TriangleScene& scene, const scene::Ray& ray,
                               std::uint32_t triangle)
{
    const RationalVec origin{ray.origin};
    const RationalVec direction{ray.direction};
    const Rational near{scene::receiver_near_m(scene.bounds())};
    const auto seen = hit_of(origin, direction, scene.corners(triangle));
    if (!seen || seen->is_outside() || seen->t <= near) {
        return false;
    }
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const auto hit = hit_of(origin, direction, scene.corners(t));
        if (hit && !hit->is_outside() && hit->t > near && hit->t < seen->t) {
            return false;
        }
    }
    return true;
}

struct Tally {
    int scored = 0;
    int blocked = 0;
    int indeterminate = 0;
};

inline Tally check_every_pixel(const TriangleScene& scene, const View& view)
{
    const auto receivers = brute_force_receivers(scene, view);
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
    Tally tally;
    for (int y = 0; y < view.image.height_px; ++y) {
        for (int x = 0; x < view.image.width_px; ++x) {
            const PixelClass found = truth.pixel_class(x, y);
            if (found == PixelClass::background || found == PixelClass::unmatched) {
                continue;
            }
            SCOPED_TRACE(testing::Message() << "pixel " << x << ", " << y);
            const scene::Ray ray = scene::pixel_ray(view.camera, view.image, x, y);
            const std::uint32_t receiver = receivers(x, y);
            EXPECT_TRUE(is_exact_first_hit(scene, ray, receiver));
            if (found == PixelClass::attached || found == PixelClass::out_of_light) {
                continue;
            }
            const RationalVec point = exact_point(ray, scene.corners(receiver));
            EXPECT_EQ(found, exact_shadowing(scene, view, point, receiver));
            tally.scored += scene::is_scored(found) ? 1 : 0;
            tally.indeterminate += found == PixelClass::indeterminate ? 1 : 0;
            tally.blocked += found == PixelClass::blocked ? 1 : 0;
        }
    }
    return tally;
}

} // namespace gnomon::reference_rt::test
