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

LightDepth::LightDepth(const scene::LightFrustum& frustum)
    : frustum_{frustum},
      rows_{frustum},
      is_parallel_{Vec3d{rows_.w} == Vec3d{0.0}},
      has_unit_w_{is_parallel_ && rows_.w.w == 1}
{
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

void LightDepth::remember(const Receiver& hit, PlaceMemory& memory) const
{
    const Vec3d& origin = hit.ray().origin;
    const bool has_origin = memory.triangle != scene::no_triangle && memory.origin == origin;
    if (!has_origin) {
        const Vec3d& forward = frustum_.forward;
        const Vec3d& eye = frustum_.origin;
        memory.origin = origin;
        memory.z_start = row_at(rows_.z, origin, 1);
        memory.w_start = is_parallel_ ? Bounded{rows_.w.w, 0} : row_at(rows_.w, origin, 1);
        memory.zeta_start = compensated_dot<6>(
            {forward.x, forward.y, forward.z, -forward.x, -forward.y, -forward.z},
            {origin.x, origin.y, origin.z, eye.x, eye.y, eye.z});
    }
    if (!has_origin || memory.triangle != hit.triangle()) {
        memory.triangle = hit.triangle();
        memory.normal = normal_of<WideField>(hit.corners());
        memory.nu = dot(memory.normal, difference<WideField>(hit.corners()[0], origin));
    }
}

LightDepth::Place LightDepth::place(const Receiver& hit, PlaceMemory& memory) const
{
    constexpr double largest_error = 0x1p-48;
    remember(hit, memory);
    const Vec3d& direction = hit.ray().direction;
    // Within a few roundings, wherever twice the precision is enough for that.
    const Bounded t = hit.is_tame() ? memory.nu.rounded() /
                                          dot(memory.normal, vector<WideField>(direction)).rounded()
                                    : parameter_of(hit);
    const ClipLine line{memory.z_start, row_at(rows_.z, direction, 0), memory.w_start,
                        is_parallel_ ? Bounded{0, 0} : row_at(rows_.w, direction, 0)};
    const Bounded depth = at(line, t);
    return {depth.error <= largest_error ? depth : Bounded{exactly_at(hit).value(), largest_error},
            zeta_m(hit, t, memory.zeta_start)};
}

double LightDepth::zeta_m(const Receiver& hit, const Bounded& t, const Bounded& zeta_start) const
{
    const Ray& ray = hit.ray();
    const Vec3d& forward = frustum_.forward;
    const Vec3d& origin = frustum_.origin;
    const Bounded step = row_at(Vec4d{forward, 0}, ray.direction, 0);
    const Bounded zeta = zeta_start + t * step;
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
