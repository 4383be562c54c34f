#include "reference_rt/exact/predicates.hpp"

#include <glm/geometric.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace gnomon::reference_rt {

using scene::Light;
using scene::LightType;
using scene::Vec3d;

namespace {

using Rational = boost::multiprecision::cpp_rational;
using RationalVec = std::array<Rational, 3>;

RationalVec rational(const Vec3d& v)
{
    return {Rational{v.x}, Rational{v.y}, Rational{v.z}};
}

RationalVec rational_difference(const RationalVec& a, const RationalVec& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RationalVec cross(const RationalVec& a, const RationalVec& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Rational dot(const RationalVec& a, const RationalVec& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalVec along(const RationalVec& from, const Rational& t, const RationalVec& step)
{
    return {from[0] + t * step[0], from[1] + t * step[1], from[2] + t * step[2]};
}

RationalVec rational_point(const Receiver& receiver)
{
    const RationalVec a = rational(receiver.corners()[0]);
    const RationalVec to_b = rational_difference(rational(receiver.corners()[1]), a);
    const RationalVec to_c = rational_difference(rational(receiver.corners()[2]), a);
    if (const BarycentricPlace* place = receiver.place) {
        return along(along(a, Rational{place->u}, to_b), Rational{place->v}, to_c);
    }
    const RationalVec normal = cross(to_b, to_c);
    const RationalVec origin = rational(receiver.ray().origin);
    const RationalVec direction = rational(receiver.ray().direction);
    const Rational t = dot(normal, rational_difference(a, origin)) / dot(normal, direction);
    return along(origin, t, direction);
}

} // namespace

// In rationals throughout: it is asked only where two signs are exactly zero.
bool runs_through(const Receiver& receiver, const Corners& s, const Light& light)
{
    const RationalVec point = rational_point(receiver);
    const RationalVec step = light.has_position()
                                 ? rational_difference(rational(light.position), point)
                                 : rational(-light.direction);
    const std::array<RationalVec, 3> corner{rational(s[0]), rational(s[1]), rational(s[2])};
    const RationalVec normal =
        cross(rational_difference(corner[1], corner[0]), rational_difference(corner[2], corner[0]));
    // Clips point + r·step, 0 < r < 1 or without end, by the three half-planes of the triangle.
    Rational enter = 0;
    std::optional<Rational> leave;
    if (light.has_position()) {
        leave = 1;
    }
    const std::optional<Rational> end = leave;
    for (std::size_t i = 0; i < 3; ++i) {
        const RationalVec inward =
            cross(normal, rational_difference(corner[(i + 1) % 3], corner[i]));
        const Rational inside = dot(inward, rational_difference(point, corner[i]));
        const Rational growth = dot(inward, step);
        if (growth == 0) {
            if (inside < 0) {
                return false;
            }
            continue;
        }
        const Rational border = -inside / growth;
        if (growth > 0) {
            enter = std::max(enter, border);
        } else if (!leave || border < *leave) {
            leave = border;
        }
    }
    const bool is_open_at_light = !end || enter < *end;
    return is_open_at_light && (!leave || (*leave > 0 && enter <= *leave));
}

} // namespace gnomon::reference_rt
