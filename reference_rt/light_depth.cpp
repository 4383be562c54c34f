#include "reference_rt/light_depth.hpp"

#include "reference_rt/terms.hpp"

#include <cmath>

namespace gnomon::reference_rt {

using scene::Ray;
using scene::Vec3d;
using scene::Vec4d;

namespace {

/// δ row·(P, 1)
template <typename Field, typename Number>
Number scaled_row(Field /*field*/, const Vec4d& row, const Ray& ray,
                  const PlaneHit<Number, Number>& plane)
{
    const auto axis = vector<Field>(Vec3d{row});
    return plane.delta * (dot(axis, vector<Field>(ray.origin)) + Field::number(row.w)) +
           plane.nu * dot(axis, vector<Field>(ray.direction));
}
/// |δ| row·(P, 1)
Dyadic scaled_row(const Vec4d& row, const Receiver& hit, const PlaneHit<Dyadic, Dyadic>& plane)
{
    const Dyadic value = scaled_row(ExactField{}, row, hit.ray(), plane);
    return hit.delta_sign > 0 ? value : Dyadic{} - value;
}

} // namespace

Bounded sharp_parameter_of(const Receiver& hit)
{
    if (!hit.is_tame()) {
        return parameter_of(hit);
    }
    const auto plane = plane_hit(WideField{}, hit);
    return plane.nu.rounded() / plane.delta.rounded();
}

LightDepth::LightDepth(const scene::LightFrustum& frustum)
    : frustum_{frustum},
      rows_{frustum},
      is_parallel_{Vec3d{rows_.w} == Vec3d{0.0}},
      has_unit_w_{is_parallel_ && rows_.w.w == 1}
{
}

ClipLine LightDepth::along(const Ray& ray) const
{
    const Bounded z_start = row_at(rows_.z, ray.origin, 1);
    const Bounded z_step = row_at(rows_.z, ray.direction, 0);
    if (is_parallel_) {
        return {z_start, z_step, {rows_.w.w, 0}, {0, 0}};
    }
    return {z_start, z_step, row_at(rows_.w, ray.origin, 1), row_at(rows_.w, ray.direction, 0)};
}

bool LightDepth::is_level(const Facet& facet) const
{
    const auto slope = cross(vector<FilterField>(Vec3d{rows_.z}), facet.normal);
    return is_parallel_ && slope.x.permanent == 0 && slope.y.permanent == 0 &&
           slope.z.permanent == 0;
}

Fraction LightDepth::exactly_at(const Receiver& hit) const
{
    if (is_level(*hit.facet)) { // short numbers, for a common case that doubles never decide
        const Dyadic w{rows_.w.w};
        const Dyadic z =
            dot(vector<ExactField>(Vec3d{rows_.z}), vector<ExactField>(hit.corners()[0])) +
            Dyadic{rows_.z.w};
        return is_reversed() ? Fraction{z, w} : Fraction{z + w, w + w};
    }
    const auto plane = plane_hit(ExactField{}, hit);
    const Dyadic z = scaled_row(rows_.z, hit, plane);
    const Dyadic w = scaled_row(rows_.w, hit, plane);
    return is_reversed() ? Fraction{z, w} : Fraction{z + w, w + w};
}

Wide LightDepth::widely_at(const Receiver& hit) const
{
    const auto plane = plane_hit(WideField{}, hit);
    const Wide z = scaled_row(WideField{}, rows_.z, hit.ray(), plane);
    const Wide w = scaled_row(WideField{}, rows_.w, hit.ray(), plane);
    return is_reversed() ? z / w : (z + w) / (w + w);
}

bool LightDepth::is_in_range(const ClipLine& line, const Receiver& hit, const Bounded& depth) const
{
    const Bounded w = has_unit_w_ ? line.w_start : line.w(parameter_of(hit));
    const Bounded rest = Bounded{1, 0} - depth;
    if (w.is_certainly_positive() && depth.is_certainly_positive() &&
        rest.is_certainly_positive()) {
        return true;
    }
    if (w.is_certainly_negative() || depth.is_certainly_negative() ||
        rest.is_certainly_negative()) {
        return false;
    }
    const Fraction exact = exactly_at(hit);
    return exact.denominator.sign() > 0 && exact.sign() >= 0 &&
           (exact - Fraction{Dyadic{1}, Dyadic{1}}).sign() <= 0;
}

LightDepth::Place LightDepth::place(const Receiver& hit) const
{
    constexpr double largest_error = 0x1p-48;
    const Bounded t = sharp_parameter_of(hit);
    const Bounded depth = at(along(hit.ray()), t);
    return {depth.error <= largest_error ? depth : Bounded{exactly_at(hit).value(), largest_error},
            zeta_m(hit, t)};
}

double LightDepth::zeta_m(const Receiver& hit, const Bounded& t) const
{
    const Ray& ray = hit.ray();
    const Vec3d& forward = frustum_.forward;
    const Vec3d& origin = frustum_.origin;
    const std::array<double, 6> axis{forward.x,  forward.y,  forward.z,
                                     -forward.x, -forward.y, -forward.z};
    const Bounded start = compensated_dot<6>(
        axis, {ray.origin.x, ray.origin.y, ray.origin.z, origin.x, origin.y, origin.z});
    const Bounded step = row_at(Vec4d{forward, 0}, ray.direction, 0);
    const Bounded zeta = start + t * step;
    if (zeta.error <= 0x1p-45 * std::abs(zeta.value)) {
        return zeta.value;
    }
    const auto plane = plane_hit(ExactField{}, hit);
    const auto along = vector<ExactField>(forward);
    return Dyadic::quotient(plane.delta * dot(along, difference<ExactField>(ray.origin, origin)) +
                                plane.nu * dot(along, vector<ExactField>(ray.direction)),
                            plane.delta);
}

} // namespace gnomon::reference_rt
