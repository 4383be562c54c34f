#include "reference_rt/light/light_depth.hpp"

#include "reference_rt/exact/terms.hpp"

#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

using scene::Ray;
using scene::Vec3d;
using scene::Vec4d;

namespace {

/// |δ| row·(P + offset, 1)
Dyadic scaled_row(const Vec4d& row, const Receiver& hit, const PlaneHit<Dyadic, Dyadic>& plane,
                  const Vec3d& offset)
{
    const Dyadic value = scaled_row(ExactField{}, row, hit.ray(), plane, offset);
    return hit.delta_sign > 0 ? value : Dyadic{} - value;
}

/// The precision of `Place`'s ζ.
bool is_near_light_distance(const Interval& light_distance_m)
{
    return std::isfinite(light_distance_m.value) &&
           light_distance_m.error <= 0x1p-45 * std::abs(light_distance_m.value);
}

} // namespace

LightDepth::LightDepth(const scene::LightFrustum& frustum)
    : frustum_{frustum},
      rows_{frustum},
      is_parallel_{Vec3d{rows_.w} == Vec3d{0.0}},
      has_unit_w_{is_parallel_ && rows_.w.w == 1}
{
}

bool LightDepth::is_level(const ExactTriangle& face) const
{
    const auto slope = cross(vector<FilterField>(Vec3d{rows_.z}), face.normal);
    return is_parallel_ && slope.x.permanent == 0 && slope.y.permanent == 0 &&
           slope.z.permanent == 0;
}

Fraction LightDepth::exactly_at(const Receiver& hit, const Vec3d& offset) const
{
    if (offset == Vec3d{0.0} &&
        is_level(*hit.face)) { // cheap exact arithmetic for a common case that doubles never decide
        const Dyadic w{rows_.w.w};
        const Dyadic z =
            dot(vector<ExactField>(Vec3d{rows_.z}), vector<ExactField>(hit.corners()[0])) +
            Dyadic{rows_.z.w};
        return is_reversed() ? Fraction{z, w} : Fraction{z + w, w + w};
    }
    const auto plane = plane_hit(ExactField{}, hit);
    const Dyadic z = scaled_row(rows_.z, hit, plane, offset);
    const Dyadic w = scaled_row(rows_.w, hit, plane, offset);
    return is_reversed() ? Fraction{z, w} : Fraction{z + w, w + w};
}

DoubleDouble LightDepth::at_double_double(const Receiver& hit, const Vec3d& offset) const
{
    const auto plane = plane_hit(DoubleDoubleField{}, hit);
    const DoubleDouble z = scaled_row(DoubleDoubleField{}, rows_.z, hit.ray(), plane, offset);
    const DoubleDouble w = scaled_row(DoubleDoubleField{}, rows_.w, hit.ray(), plane, offset);
    return is_reversed() ? z / w : (z + w) / (w + w);
}

bool LightDepth::is_in_range(const ClipLine& line, const Receiver& hit, const Interval& depth) const
{
    const Interval w = has_unit_w_ ? line.w_start : line.w(parameter_of(hit));
    const Interval rest = Interval{1, 0} - depth;
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
           (exact - Fraction::number(1)).sign() <= 0;
}

Interval LightDepth::closely_at(const ClipLine& line, const Interval& t) const
{
    if (is_parallel_) {
        return at(line, t);
    }
    // d/dt z/w = (z_step w_start − z_start w_step)/w²; this is a lower bound of w within t's error.
    const Interval turn = line.z_step * line.w_start - line.z_start * line.w_step;
    const Interval w = line.w(t);
    const double smallest_w = std::abs(w.value) - w.error;
    if (!(smallest_w > 0)) {
        return {0, std::numeric_limits<double>::infinity()};
    }
    // The factor covers the roundings of the bound.
    const double largest_slope =
        1.01 * (std::abs(turn.value) + turn.error) / (smallest_w * smallest_w);
    return at(line, {t.value, 0}) + Interval{0, largest_slope * t.error};
}

void LightDepth::remember_origin(const Receiver& hit, PlaceMemory& memory) const
{
    const Vec3d& origin = hit.ray().origin;
    if (memory.has_origin && memory.origin == origin) {
        return;
    }
    const Vec3d& forward = frustum_.forward;
    const Vec3d& eye = frustum_.origin;
    memory = {};
    memory.has_origin = true;
    memory.origin = origin;
    memory.z_start = row_at(rows_.z, origin, 1);
    memory.w_start = is_parallel_ ? Interval{rows_.w.w, 0} : row_at(rows_.w, origin, 1);
    memory.light_distance_start =
        compensated_dot<6>({forward.x, forward.y, forward.z, -forward.x, -forward.y, -forward.z},
                           {origin.x, origin.y, origin.z, eye.x, eye.y, eye.z});
}

Interval LightDepth::sharp_parameter(const Receiver& hit, PlaceMemory& memory)
{
    if (!hit.is_well_scaled()) {
        return parameter_of(hit);
    }
    if (memory.triangle != hit.triangle()) {
        memory.triangle = hit.triangle();
        memory.normal = normal_of<DoubleDoubleField>(hit.corners());
        memory.nu =
            dot(memory.normal, difference<DoubleDoubleField>(hit.corners()[0], memory.origin));
    }
    return memory.nu.rounded() /
           dot(memory.normal, vector<DoubleDoubleField>(hit.ray().direction)).rounded();
}

LightDepth::Place LightDepth::place(const Receiver& hit, PlaceMemory& memory) const
{
    constexpr double largest_error = 0x1p-48;
    remember_origin(hit, memory);
    const Vec3d& direction = hit.ray().direction;
    const Vec4d forward{frustum_.forward, 0};
    const auto line_along = [&](const auto& row_along) {
        return ClipLine{memory.z_start, row_along(rows_.z, direction, 0), memory.w_start,
                        is_parallel_ ? Interval{0, 0} : row_along(rows_.w, direction, 0)};
    };
    const Interval plain_t = parameter_of(hit);
    const Interval plain_depth = closely_at(line_along(plain_row_at), plain_t);
    const Interval plain_light_distance =
        memory.light_distance_start + plain_t * plain_row_at(forward, direction, 0);
    if (plain_depth.error <= largest_error && is_near_light_distance(plain_light_distance)) {
        return {plain_depth, plain_light_distance.value};
    }
    const Interval t = sharp_parameter(hit, memory);
    const Interval depth = at(line_along(row_at), t);
    const Interval light_distance = memory.light_distance_start + t * row_at(forward, direction, 0);
    return {depth.error <= largest_error ? depth : Interval{exactly_at(hit).value(), largest_error},
            is_near_light_distance(light_distance) ? light_distance.value
                                                   : exact_light_distance_m(hit)};
}

double LightDepth::exact_light_distance_m(const Receiver& hit) const
{
    const Ray& ray = hit.ray();
    const Vec3d& origin = frustum_.origin;
    const auto plane = plane_hit(ExactField{}, hit);
    const auto along = vector<ExactField>(frustum_.forward);
    return Dyadic::quotient(plane.delta * dot(along, difference<ExactField>(ray.origin, origin)) +
                                plane.nu * dot(along, vector<ExactField>(ray.direction)),
                            plane.delta);
}

} // namespace gnomon::reference_rt
