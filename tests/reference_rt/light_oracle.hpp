#pragma once

#include "exact_oracle.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "renderers/light_queries.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

/// Answers light queries by testing every triangle in rationals.
namespace gnomon::reference_rt::test {

/// A point where a line passes through the surface.
struct Passing {
    Rational t;
    std::uint32_t triangle = scene::no_triangle;
};

/// A triangle that a line meets exactly on one edge.
struct EdgePassing {
    Rational t;
    std::uint32_t triangle;
    scene::Vec3f from, to;
    int side; ///< of the third corner from the line, across the edge
};

inline int sign(const Rational& x)
{
    return x.sign();
}

/// The only one of three barycentric coordinates that is 0; its corner is opposite the edge met.
inline std::optional<std::size_t> single_zero(const std::array<Rational, 3>& weight)
{
    std::optional<std::size_t> zero;
    for (std::size_t i = 0; i < 3; ++i) {
        if (weight[i] == 0) {
            if (zero) {
                return std::nullopt;
            }
            zero = i;
        }
    }
    return zero;
}

/// How a line meets the edge opposite a triangle's corner.
inline EdgePassing edge_passing(const RationalVec& step, std::uint32_t triangle,
                                const std::array<scene::Vec3f, 3>& corner, std::size_t opposite,
                                const Rational& t)
{
    scene::Vec3f from = corner[(opposite + 1) % 3];
    scene::Vec3f to = corner[(opposite + 2) % 3];
    // Both triangles of an edge must compute their sides from the same end.
    if (std::tie(from.x, from.y, from.z) > std::tie(to.x, to.y, to.z)) {
        std::swap(from, to);
    }
    const RationalVec start{scene::Vec3d{from}};
    const Rational side = dot(cross(RationalVec{scene::Vec3d{to}} - start, step),
                              RationalVec{scene::Vec3d{corner[opposite]}} - start);
    return {t, triangle, from, to, sign(side)};
}

/// Where origin + t·step properly crosses casting triangles that `is_kept_by_culling`, or seams of
/// two.
/// @param is_kept_by_culling  for the sign of normal·step.
inline std::vector<Passing> passings(const scene::TriangleScene& scene, const RationalVec& origin,
                                     const RationalVec& step,
                                     const std::function<bool(int)>& is_kept_by_culling)
{
    std::vector<Passing> found;
    std::vector<EdgePassing> edges;
    for (const auto& range : scene::casting_ranges(scene)) {
        for (std::uint32_t t = range.first; t < range.first + range.count; ++t) {
            const auto corner = scene.corners(t);
            const auto hit = hit_of(origin, step, corner);
            const RationalVec a{scene::Vec3d{corner[0]}};
            const RationalVec normal = cross(RationalVec{scene::Vec3d{corner[1]}} - a,
                                             RationalVec{scene::Vec3d{corner[2]}} - a);
            if (!hit || hit->is_outside() || !is_kept_by_culling(sign(dot(normal, step)))) {
                continue;
            }
            if (hit->is_inside()) {
                found.push_back({hit->t, t});
            } else if (const auto zero = single_zero({1 - hit->u - hit->v, hit->u, hit->v})) {
                edges.push_back(edge_passing(step, t, corner, *zero, hit->t));
            }
        }
    }
    for (const EdgePassing& a : edges) {
        for (const EdgePassing& b : edges) {
            if (a.from == b.from && a.to == b.to && a.side * b.side < 0) {
                found.push_back({a.t, std::min(a.triangle, b.triangle)});
            }
        }
    }
    return found;
}

/// Whether culling keeps triangles that face the light (1) or face away from it (−1).
inline bool culling_leaves(scene::Cull cull, int facing)
{
    return facing != 0 && !(cull == scene::Cull::front && facing > 0) &&
           !(cull == scene::Cull::back && facing < 0);
}

/// The exact matrix depth of a point; empty if it is not in front of the light.
inline std::optional<Rational> matrix_depth(const scene::LightFrustum& frustum,
                                            const RationalVec& point)
{
    const auto& m = frustum.light_clip_from_world;
    const auto row = [&](int i) {
        return Rational{static_cast<double>(m[0][i])} * point.x +
               Rational{static_cast<double>(m[1][i])} * point.y +
               Rational{static_cast<double>(m[2][i])} * point.z +
               Rational{static_cast<double>(m[3][i])};
    };
    const Rational w = row(3);
    if (w <= 0) {
        return std::nullopt;
    }
    const Rational ratio = row(2) / w;
    return frustum.reversed ? ratio : Rational{(ratio + 1) / 2};
}

inline bool is_between_near_and_far(const scene::LightFrustum& frustum, const RationalVec& point)
{
    const auto depth = matrix_depth(frustum, point);
    return depth && *depth >= 0 && *depth <= 1;
}

/// The first hit along a texel's ray; `no_triangle` without one.
inline Passing first_hit_of(const scene::TriangleScene& scene, const scene::View& view,
                            const scene::Ray& ray, scene::Cull cull)
{
    const RationalVec origin{ray.origin};
    const RationalVec step{ray.direction};
    Passing first;
    for (const Passing& passing :
         passings(scene, origin, step, [&](int side) { return culling_leaves(cull, -side); })) {
        if (!is_between_near_and_far(view.first_map(), origin + passing.t * step)) {
            continue;
        }
        if (first.triangle == scene::no_triangle || passing.t < first.t ||
            (passing.t == first.t && passing.triangle < first.triangle)) {
            first = passing;
        }
    }
    return first;
}

/// Whether a triangle that a map can hold crosses the segment P→light.
inline bool is_crossed(const scene::TriangleScene& scene, const scene::View& view,
                       const RationalVec& point, scene::Cull cull)
{
    const bool is_directional = view.light.type == scene::LightType::directional;
    const RationalVec step = is_directional ? RationalVec{-view.light.direction}
                                            : RationalVec{view.light.position} - point;
    for (const Passing& passing :
         passings(scene, point, step, [&](int side) { return culling_leaves(cull, side); })) {
        if (passing.t > 0 && (is_directional || passing.t < 1) &&
            is_between_near_and_far(view.first_map(), point + passing.t * step)) {
            return true;
        }
    }
    return false;
}

/// The smallest bias >= x, found by stepping from a nearby float.
inline float smallest_bias(const Rational& x)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const auto is_bias = [](float b) { return b == 0 || std::isnormal(b); };
    auto bias = static_cast<float>(x.convert_to<double>());
    bias = is_bias(bias) ? bias : 0.0F;
    const auto stepped = [&](float from, float towards) {
        float next = std::nextafter(from, towards);
        if (!is_bias(next)) { // across the subnormal numbers
            const float edge = std::copysign(std::numeric_limits<float>::min(), next);
            next = from == 0 ? edge : 0.0F;
        }
        return next;
    };
    while (Rational{static_cast<double>(bias)} < x) {
        bias = stepped(bias, infinity);
    }
    while (Rational{static_cast<double>(stepped(bias, -infinity))} >= x) {
        bias = stepped(bias, -infinity);
    }
    return bias;
}

/// The float32 nearest to x, ties to even, found by stepping from a nearby float. Precondition: x
/// is not beyond the largest float32.
inline float nearest_float(const Rational& x)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const auto guess = static_cast<float>(x.convert_to<double>());
    const auto distance = [&](float f) {
        return Rational{abs(Rational{static_cast<double>(f)} - x)};
    };
    const auto is_even = [](float f) { return std::bit_cast<std::uint32_t>(f) % 2 == 0; };
    float best = guess;
    for (const float f : {std::nextafter(guess, -infinity), std::nextafter(guess, infinity)}) {
        if (distance(f) < distance(best) || (distance(f) == distance(best) && is_even(f))) {
            best = f;
        }
    }
    return best;
}

} // namespace gnomon::reference_rt::test
