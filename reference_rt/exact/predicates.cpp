#include "reference_rt/exact/predicates.hpp"

#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/terms.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gnomon::reference_rt {

using scene::Light;
using scene::LightType;
using scene::Ray;
using scene::Vec3d;

namespace {

/// The double that `Dyadic::quotient` returns for the exact numbers, if double-double arithmetic
/// proves it.
std::optional<double> certain_quotient(const DoubleDouble& numerator,
                                       const DoubleDouble& denominator)
{
    const DoubleDouble quotient = numerator / denominator;
    // `Dyadic::quotient` truncates below 2^-61 of the quotient, then rounds.
    const double reach = quotient.error + 0x1p-60 * std::abs(quotient.high);
    const bool is_certain = quotient.high + (quotient.low + reach) == quotient.high &&
                            quotient.high + (quotient.low - reach) == quotient.high;
    return is_certain ? std::optional{quotient.high} : std::nullopt;
}

/// a − b, if it is a double.
std::optional<double> exact_difference(double a, double b)
{
    const DoubleDouble difference = exact_sum(a, -b);
    return difference.low == 0 ? std::optional{difference.high + 0.0} : std::nullopt; // avoids −0
}

/// P − origin, if exact arithmetic is not needed to know its result.
std::optional<Vec3d> certain_offset(const Receiver& receiver, const Vec3d& origin)
{
    if (receiver.place != nullptr || !receiver.is_well_scaled()) {
        return std::nullopt;
    }
    const Ray& ray = receiver.ray();
    const auto [delta, nu] = plane_hit(DoubleDoubleField{}, receiver);
    const auto& normal = receiver.face->normal;
    const std::array<bool, 3> is_across{normal.x.permanent == 0, normal.y.permanent == 0,
                                        normal.z.permanent == 0};
    Vec3d offset{0.0};
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        // A plane perpendicular to an axis has a constant coordinate on it.
        const bool is_level = is_across[(axis + 1) % 3] && is_across[(axis + 2) % 3];
        const auto part =
            is_level
                ? exact_difference(receiver.corners()[0][k], origin[k])
                : certain_quotient(delta * DoubleDoubleField::difference(ray.origin[k], origin[k]) +
                                       nu * DoubleDoubleField::number(ray.direction[k]),
                                   delta);
        if (!part) {
            return std::nullopt;
        }
        offset[k] = *part;
    }
    return offset;
}

} // namespace

Sign Receiver::exact_delta_sign(SignCounts& counts) const
{
    return exact_sign(counts, [&](auto field) { return plane_hit(field, *this).delta; });
}

Vec3d exact_offset(const Receiver& receiver, const Vec3d& origin)
{
    if (const auto offset = certain_offset(receiver, origin)) {
        return *offset;
    }
    const auto offset = scaled_offset(ExactField{}, receiver, origin);
    const Dyadic delta =
        receiver.place != nullptr ? Dyadic{1.0} : plane_hit(ExactField{}, receiver).delta;
    return {Dyadic::quotient(offset.x, delta), Dyadic::quotient(offset.y, delta),
            Dyadic::quotient(offset.z, delta)};
}

Vec3d sharp_point(const Receiver& receiver)
{
    return exact_offset(receiver, Vec3d{0.0});
}

Vec3d exact_offset(const Ray& ray, double t, const Vec3d& origin)
{
    const Dyadic one{1.0};
    const auto offset =
        difference<ExactField>(ray.origin, origin) + Dyadic{t} * vector<ExactField>(ray.direction);
    return {Dyadic::quotient(offset.x, one), Dyadic::quotient(offset.y, one),
            Dyadic::quotient(offset.z, one)};
}

Sign passing_side(const CameraRay& ray, const Vec3d& u, const Vec3d& v, SignCounts& counts)
{
    return sign_of(counts, ray.is_well_scaled, [&]<typename Field>(Field) {
        const auto normal = cross(difference<Field>(u, ray.ray.origin), difference<Field>(v, u));
        return dot(normal, vector<Field>(ray.ray.direction));
    });
}

bool is_beyond(const Receiver& hit, double near, SignCounts& counts)
{
    return hit.delta_sign * sign_of(counts, hit.is_well_scaled(),
                                    [&]<typename Field>(Field field) {
                                        const auto [delta, nu] = plane_hit(field, hit);
                                        return nu - Field::number(near) * delta;
                                    }) >
           0;
}

Sign compare_distance(const Receiver& a, const Receiver& b, SignCounts& counts)
{
    const auto formula = [&](auto field) {
        const auto p = plane_hit(field, a);
        const auto q = plane_hit(field, b);
        return p.nu * q.delta - q.nu * p.delta;
    };
    if (const auto sign = filtered_sign(counts, a.is_well_scaled(), formula)) {
        return a.delta_sign * b.delta_sign * *sign;
    }
    return is_coplanar(a, b.corners(), counts)
               ? 0
               : a.delta_sign * b.delta_sign * exact_sign(counts, formula);
}

bool is_coplanar(const Receiver& receiver, const Corners& s, SignCounts& counts)
{
    const Corners& t = receiver.corners();
    return std::ranges::all_of(s, [&](const Vec3d& corner) {
        return corner == t[0] || corner == t[1] || corner == t[2] ||
               sign_of(counts, true, [&]<typename Field>(Field) {
                   return dot(normal_of<Field>(t), difference<Field>(corner, t[0]));
               }) == 0;
    });
}

Sign light_side(const Corners& corners, const Light& light, SignCounts& counts)
{
    return sign_of(counts, true, [&]<typename Field>(Field) {
        return dot(normal_of<Field>(corners), towards<Field>(light, corners[0]));
    });
}

Sign light_side(const ExactTriangle& face, const Light& light, SignCounts& counts)
{
    const auto sign = filtered_sign(counts, true, [&]<typename Field>(Field) {
        return dot(face.normal, towards<Field>(light, face.corners[0]));
    });
    return sign ? *sign : exact_sign(counts, [&]<typename Field>(Field) {
        return dot(normal_of<Field>(face.corners), towards<Field>(light, face.corners[0]));
    });
}

bool is_out_of_light(const Receiver& receiver, const Light& light, SignCounts& counts)
{
    if (!light.has_cone()) {
        return false;
    }
    const auto from_light = [&](auto field) {
        return scaled_offset(field, receiver, light.position); // δ(P − L)
    };
    const bool is_well_scaled = receiver.is_well_scaled();
    const Sign along = sign_of(counts, is_well_scaled, [&]<typename Field>(Field field) {
        return dot(from_light(field), vector<Field>(light.direction));
    });
    if (receiver.delta_sign * along <= 0) {
        return true;
    }
    return sign_of(counts, is_well_scaled, [&]<typename Field>(Field field) {
               const auto axis = vector<Field>(light.direction);
               const auto offset = from_light(field);
               const auto projection = dot(offset, axis);
               const auto cosine = Field::number(light.cos_half_cone);
               return projection * projection -
                      cosine * cosine * dot(offset, offset) * dot(axis, axis);
           }) < 0;
}

ShadowSigns shadow_signs(const Receiver& receiver, const Corners& s, const Light& light,
                         SignCounts& counts)
{
    const auto& [u, v, w] = s;
    return {{point_side(receiver, u, v, light, counts), point_side(receiver, v, w, light, counts),
             point_side(receiver, w, u, light, counts)},
            point_sign(receiver, s, counts),
            light_side(s, light, counts)};
}

Sign point_sign(const Receiver& receiver, const Corners& s, SignCounts& counts)
{
    const auto formula = [&]<typename Field>(Field field) {
        return scaled_side(field, receiver, normal_of<Field>(s), s[0]);
    };
    if (const auto sign = filtered_sign(counts, receiver.is_well_scaled(), formula)) {
        return receiver.delta_sign * *sign;
    }
    // P lies in the plane of T. If S does as well, three signs of low degree prove it faster.
    const bool has_plane = receiver.triangle() != scene::no_triangle;
    return has_plane && is_coplanar(receiver, s, counts)
               ? 0
               : receiver.delta_sign * exact_sign(counts, formula);
}

Sign point_side(const Receiver& receiver, const Vec3d& u, const Vec3d& v, const Light& light,
                SignCounts& counts)
{
    return receiver.delta_sign *
           sign_of(counts, receiver.is_well_scaled() && is_well_scaled(light.direction),
                   [&]<typename Field>(Field field) {
                       const auto normal = cross(difference<Field>(v, u), towards<Field>(light, u));
                       return scaled_side(field, receiver, normal, u);
                   });
}

Sign apex_side(const Light& light, const Vec3d& u, const Vec3d& v, const Vec3d& apex,
               SignCounts& counts)
{
    return sign_of(counts, is_well_scaled(light.direction), [&]<typename Field>(Field) {
        return dot(cross(difference<Field>(v, u), towards<Field>(light, u)),
                   difference<Field>(apex, u));
    });
}

bool forms_seam(const EdgeOf& a, const EdgeOf& b, const Light& light, SignCounts& counts)
{
    const bool is_shared = (a.u == b.u && a.v == b.v) || (a.u == b.v && a.v == b.u);
    return is_shared && is_seam(apex_side(light, a.u, a.v, a.apex, counts),
                                apex_side(light, a.u, a.v, b.apex, counts));
}

Sign compare_nearness_to_light(const Receiver& receiver, const Corners& a, const Corners& b,
                               const Light& light, SignCounts& counts)
{
    // The height of P above the plane of S is A/δ with A = δM·(P − u). Towards the light it changes
    // by B = M·g(u), which has the opposite sign. The crossing is at A/(A − δB) of a segment, or at
    // −A/(δB) of a directional light's ray; both grow with |A/B|.
    const auto heights = [&]<typename Field>(Field field, const Corners& s) {
        const auto normal = normal_of<Field>(s);
        return std::pair{scaled_side(field, receiver, normal, s[0]),
                         dot(normal, towards<Field>(light, s[0]))};
    };
    const Sign product = sign_of(counts, receiver.is_well_scaled(), [&](auto field) {
        const auto [a_point, a_light] = heights(field, a);
        const auto [b_point, b_light] = heights(field, b);
        return a_point * b_light - b_point * a_light;
    });
    // |A_a B_b| − |A_b B_a| = f (A_a B_b − A_b B_a), f = −sgn(δ) sgn(A_a) sgn(A_b), and with
    // sgn(A) = −sgn(δ) sgn(B): f = −sgn(δ) sgn(B_a) sgn(B_b).
    return -receiver.delta_sign * light_side(a, light, counts) * light_side(b, light, counts) *
           product;
}

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

// Uses rationals, as it runs only if two signs are exactly zero.
bool runs_through(const Receiver& receiver, const Corners& s, const Light& light)
{
    const RationalVec point = rational_point(receiver);
    const RationalVec step = light.has_position()
                                 ? rational_difference(rational(light.position), point)
                                 : rational(-light.direction);
    const std::array<RationalVec, 3> corner{rational(s[0]), rational(s[1]), rational(s[2])};
    const RationalVec normal =
        cross(rational_difference(corner[1], corner[0]), rational_difference(corner[2], corner[0]));
    // Clips point + r·step, with 0 < r < 1 or unbounded r, by the triangle's three half-planes.
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
