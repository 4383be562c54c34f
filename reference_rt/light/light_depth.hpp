#pragma once

#include "reference_rt/exact/arithmetic.hpp"
#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "scene/camera/camera.hpp"
#include "scene/light/frustum.hpp"

namespace gnomon::reference_rt {

/// z and w of the light's clip space along a ray, each as start + t·step.
struct ClipLine {
    Interval z_start, z_step;
    Interval w_start, w_step;

    [[nodiscard]] Interval z(const Interval& t) const { return z_start + t * z_step; }
    [[nodiscard]] Interval w(const Interval& t) const { return w_start + t * w_step; }
};

/// An exact quotient.
struct Fraction {
    static constexpr double relative_error = 0x1p-51; ///< of `value()`

    Dyadic numerator;
    Dyadic denominator;

    /// Precondition: `x` is finite.
    [[nodiscard]] static Fraction number(double x) { return {Dyadic{x}, Dyadic{1}}; }
    [[nodiscard]] Sign sign() const { return numerator.sign() * denominator.sign(); }
    /// Within a relative 2^-52.
    [[nodiscard]] double value() const { return Dyadic::quotient(numerator, denominator); }
    /// The sign of this − x.
    [[nodiscard]] Sign sign_beyond(double x) const { return (*this - number(x)).sign(); }
    friend Fraction operator-(const Fraction& a, const Fraction& b)
    {
        return {a.numerator * b.denominator - b.numerator * a.denominator,
                a.denominator * b.denominator};
    }
    friend Fraction operator*(const Fraction& a, const Fraction& b)
    {
        return {a.numerator * b.numerator, a.denominator * b.denominator};
    }
};

/// The matrix depth of a point H by the float32 `light_clip_from_world` with rows Z and W:
/// ½(Z·H)/(W·H) + ½, or (Z·H)/(W·H) if reversed.
class LightDepth {
public:
    explicit LightDepth(const scene::LightFrustum& frustum);

    [[nodiscard]] const ClipRows& rows() const { return rows_; }
    [[nodiscard]] bool is_reversed() const { return frustum_.reversed; }

    /// Computed with plain sums.
    [[nodiscard]] ClipLine plainly_along(const scene::Ray& ray) const
    {
        return {plain_row_at(rows_.z, ray.origin, 1), plain_row_at(rows_.z, ray.direction, 0),
                is_parallel_ ? Interval{rows_.w.w, 0} : plain_row_at(rows_.w, ray.origin, 1),
                is_parallel_ ? Interval{0, 0} : plain_row_at(rows_.w, ray.direction, 0)};
    }

    /// As above, for points moved by an offset.
    [[nodiscard]] ClipLine plainly_along(const scene::Ray& ray, const scene::Vec3d& offset) const
    {
        ClipLine line = plainly_along(ray);
        line.z_start = line.z_start + plain_row_at(rows_.z, offset, 0);
        if (!is_parallel_) {
            line.w_start = line.w_start + plain_row_at(rows_.w, offset, 0);
        }
        return line;
    }

    /// The depth at the ray parameter `t`.
    [[nodiscard]] Interval at(const ClipLine& line, const Interval& t) const
    {
        const Interval ratio = has_unit_w_ ? line.z(t) : line.z(t) / line.w(t);
        constexpr Interval half{0.5, 0};
        return is_reversed() ? ratio : half * ratio + half;
    }
    /// A tighter bound than `at`, which ignores that z and w depend on the same t.
    [[nodiscard]] Interval closely_at(const ClipLine& line, const Interval& t) const;
    /// The exact depth. The denominator has the sign of W·H, and is 0 in the light's camera plane.
    /// Precondition: δ is not 0.
    /// @param offset  from the hit to the point.
    [[nodiscard]] Fraction exactly_at(const Receiver& hit,
                                      const scene::Vec3d& offset = scene::Vec3d{0.0}) const;

    /// The depth in double-double precision. Precondition: the hit is well scaled.
    [[nodiscard]] DoubleDouble
    at_double_double(const Receiver& hit, const scene::Vec3d& offset = scene::Vec3d{0.0}) const;

    /// Whether the point is in front of the light with a depth in [0, 1].
    /// @param depth  the point's depth from `at`.
    [[nodiscard]] bool is_in_range(const ClipLine& line, const Receiver& hit,
                                   const Interval& depth) const;

    /// A hit's depth within 2^-48 if in [0, 1], and ζ to a relative 2^-44.
    struct Place {
        Interval depth;
        double light_distance_m = 0;
    };
    /// Cached values of hits with the same ray origin and the same triangle.
    struct PlaceMemory {
        bool has_origin = false;
        scene::Vec3d origin{};
        Interval z_start, w_start;
        Interval light_distance_start; ///< ζ of the origin
        std::uint32_t triangle = scene::no_triangle;
        Vec3<DoubleDouble> normal{}; ///< n
        DoubleDouble nu;             ///< n·(a − E)
    };
    /// @param memory  cache for this light and one scene; updated.
    [[nodiscard]] Place place(const Receiver& hit, PlaceMemory& memory) const;

private:
    /// Whether the triangle's plane certainly has constant depth, as it faces a directional light.
    [[nodiscard]] bool is_level(const ExactTriangle& face) const;
    void remember_origin(const Receiver& hit, PlaceMemory& memory) const;
    /// The hit's ray parameter within a few roundings, if double-double precision suffices.
    /// @param memory  cache for the hit's origin.
    [[nodiscard]] static Interval sharp_parameter(const Receiver& hit, PlaceMemory& memory);
    /// ζ of the hit, rounded. Precondition: δ is not 0.
    [[nodiscard]] double exact_light_distance_m(const Receiver& hit) const;

    const scene::LightFrustum& frustum_;
    ClipRows rows_;
    bool is_parallel_; ///< w is constant
    bool has_unit_w_;  ///< w is 1
};

/// The ray parameter of a hit.
[[nodiscard]] inline Interval parameter_of(const Receiver& hit)
{
    return {hit.t, hit.t_error};
}

} // namespace gnomon::reference_rt
