#pragma once

#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

namespace gnomon::reference_rt {

/// An exact depth, or its square with a shift that is added to the root.
struct ExactDepth {
    Fraction number;
    bool is_square = false;
    double shift = 0; ///< 0 unless `is_square`

    [[nodiscard]] Fraction square() const { return is_square ? number : number * number; }
};

/// The distance that a map stores for a point H instead of its matrix depth. With L, o and far as
/// float32, and W the matrix's last row: |H − L| / far along rays, with o = 0, or (W·(H, 1) − o) /
/// (far − o) along the axis. Points beyond 1 are ignored.
class LightDistance {
public:
    /// @param frustum  of a positional light whose map stores distances.
    explicit LightDistance(const scene::LightFrustum& frustum);

    /// Computed with plain sums; the bound includes the error of the hit's parameter.
    /// @param offset  from the hit to the point; also below.
    [[nodiscard]] Interval at(const Receiver& hit,
                              const scene::Vec3d& offset = scene::Vec3d{0.0}) const;
    /// In double-double precision. Precondition: the hit is well scaled.
    [[nodiscard]] DoubleDouble
    at_double_double(const Receiver& hit, const scene::Vec3d& offset = scene::Vec3d{0.0}) const;
    /// The exact distance, squared along rays. Precondition: δ is not 0.
    [[nodiscard]] ExactDepth exactly_at(const Receiver& hit,
                                        const scene::Vec3d& offset = scene::Vec3d{0.0}) const;
    /// In [0, 1], within 2^-48.
    [[nodiscard]] Interval place(const Receiver& hit) const;

private:
    bool is_root_;
    scene::Vec3d light_; ///< L
    scene::Vec4d axis_;  ///< W
    float origin_m_;     // floats, for GCC 12 drops two roundings side by side (scene/vec.hpp)
    float far_m_;
};

/// The square root of a number >= 0.
struct Root {
    static constexpr double relative_error = 0x1p-51;

    Fraction square;

    [[nodiscard]] Sign sign() const { return square.sign(); }
    /// Within `relative_error`.
    [[nodiscard]] double value() const;
    /// The sign of the root − number.
    [[nodiscard]] Sign sign_beyond(double number) const;
};

/// √a − √b
struct RootDifference {
    static constexpr double relative_error = 0x1p-49;

    Fraction a, b;

    [[nodiscard]] Sign sign() const { return (a - b).sign(); }
    [[nodiscard]] double value() const;
    [[nodiscard]] Sign sign_beyond(double number) const
    {
        return sign_beyond(Fraction::number(number));
    }
    [[nodiscard]] Sign sign_beyond(const Fraction& c) const;
};

/// √a − √b + shift
struct ShiftedRoots {
    /// Allows for cancellation between roots and shift. It suffices, as neighbouring float32 are
    /// 2^-24 apart and exact ties have no error.
    static constexpr double relative_error = 0x1p-40;

    RootDifference roots;
    double shift = 0;

    [[nodiscard]] Sign sign() const { return sign_beyond(0); }
    [[nodiscard]] double value() const { return roots.value() + shift; }
    [[nodiscard]] Sign sign_beyond(double number) const
    {
        return roots.sign_beyond(Fraction::number(number) - Fraction::number(shift));
    }
};

} // namespace gnomon::reference_rt
