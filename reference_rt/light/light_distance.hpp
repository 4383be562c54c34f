#pragma once

#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/exact/wide.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

namespace gnomon::reference_rt {

/// An exact depth, or its square and what is added to its root.
struct ExactDepth {
    Fraction number;
    bool is_square = false;
    double shift = 0; ///< 0 unless it is a square

    [[nodiscard]] Fraction square() const { return is_square ? number : number * number; }
};

/// What a map holds of a point H in place of its matrix depth, with L, o and far as GL has them, in
/// float32, and W the last row of the matrix: along rays |H − L| / far, of which o is 0, along the
/// axis (W·(H, 1) − o) / (far − o). What is farther than 1 is as good as not there.
class LightDistance {
public:
    /// @param frustum  of a light with a position, whose map does not hold depths.
    explicit LightDistance(const scene::LightFrustum& frustum);

    /// To within the roundings of plain sums, and what those of the hit's parameter amount to.
    /// @param offset  of the point from the hit; also below.
    [[nodiscard]] Interval at(const Receiver& hit,
                              const scene::Vec3d& offset = scene::Vec3d{0.0}) const;
    /// In twice double's precision. Precondition: the hit is well scaled.
    [[nodiscard]] Wide widely_at(const Receiver& hit,
                                 const scene::Vec3d& offset = scene::Vec3d{0.0}) const;
    /// Along rays its square. Precondition: δ is not 0.
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

/// The root of a number that is not negative.
struct Root {
    static constexpr double relative_error = 0x1p-51;

    Fraction square;

    [[nodiscard]] Sign sign() const { return square.sign(); }
    /// Within `relative_error` of its size.
    [[nodiscard]] double value() const;
    /// Sign of the root less a number.
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
    /// As the roots may nearly cancel the shift, of a value that leaves some doubt: neighbouring
    /// float32 are 2^-24 apart, and exact ties have no error.
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
