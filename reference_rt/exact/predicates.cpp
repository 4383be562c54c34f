#include "reference_rt/exact/predicates.hpp"

#include "reference_rt/exact/terms.hpp"
#include "reference_rt/exact/wide.hpp"

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

/// The double that `Dyadic::quotient` gives for the exact numbers, where twice double's precision
/// proves it.
std::optional<double> certain_quotient(const Wide& numerator, const Wide& denominator)
{
    const Wide quotient = numerator / denominator;
    // That function cuts off what is below 2^-61 of the quotient, and then rounds.
    const double reach = quotient.error + 0x1p-60 * std::abs(quotient.high);
    const bool is_certain = quotient.high + (quotient.low + reach) == quotient.high &&
                            quotient.high + (quotient.low - reach) == quotient.high;
    return is_certain ? std::optional{quotient.high} : std::nullopt;
}

/// a − b, where it is a double.
std::optional<double> exact_difference(double a, double b)
{
    const Wide difference = exact_sum(a, -b);
    return difference.low == 0 ? std::optional{difference.high + 0.0} : std::nullopt; // never −0
}

/// P − origin, where it takes no integers to know what those would give.
std::optional<Vec3d> certain_offset(const Receiver& receiver, const Vec3d& origin)
{
    if (receiver.place != nullptr || !receiver.is_well_scaled()) {
        return std::nullopt;
    }
    const Ray& ray = receiver.ray();
    const auto [delta, nu] = plane_hit(WideField{}, receiver);
    const auto& normal = receiver.face->normal;
    const std::array<bool, 3> is_across{normal.x.permanent == 0, normal.y.permanent == 0,
                                        normal.z.permanent == 0};
    Vec3d offset{0.0};
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        // All of a plane that faces an axis has one coordinate there.
        const bool is_level = is_across[(axis + 1) % 3] && is_across[(axis + 2) % 3];
        const auto part =
            is_level ? exact_difference(receiver.corners()[0][k], origin[k])
                     : certain_quotient(delta * WideField::difference(ray.origin[k], origin[k]) +
                                            nu * WideField::number(ray.direction[k]),
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
    // P lies in the plane of T: where S does too, three signs of low degree say so sooner.
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
    // At P the height above the plane of S is A/δ, A = δM·(P − u), and it changes towards the light
    // by B = M·g(u), of the other sign: the crossing is at A/(A − δB) of a segment, at −A/(δB) of a
    // sun's ray. Both grow with |A/B|.
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

} // namespace gnomon::reference_rt
