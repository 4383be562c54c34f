#pragma once

#include "reference_rt/exact/bounded.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/exact/wide.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

namespace gnomon::reference_rt {

/// What a map of distances holds of a point H: |H − L| over the map's far plane, both as GL has
/// them, in float32; what is farther is as good as not there.
class LightDistance {
public:
    /// @param frustum  of a light with a position.
    explicit LightDistance(const scene::LightFrustum& frustum)
        : light_{frustum.origin},
          far_m_{static_cast<float>(frustum.far_m)}
    {
    }

    /// To within the roundings of plain sums, and what those of the hit's parameter amount to.
    [[nodiscard]] Bounded at(const Receiver& hit) const;
    /// In twice double's precision. Precondition: the hit is well scaled.
    [[nodiscard]] Wide widely_at(const Receiver& hit) const;
    /// Its square, exactly. Precondition: δ is not 0.
    [[nodiscard]] Fraction square_at(const Receiver& hit) const;
    /// At most 1, within 2^-48.
    [[nodiscard]] Bounded place(const Receiver& hit) const;

private:
    scene::Vec3d light_; ///< L
    double far_m_;
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
    [[nodiscard]] Sign sign_beyond(double number) const;
};

} // namespace gnomon::reference_rt
