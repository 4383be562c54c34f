#pragma once

#include "scene/vec.hpp"

#include <array>

namespace gnomon::tests {

/// The first four moments of depths; B is their Hankel matrix.
using Moments = scene::Vec4d;

/// Blends the moments with those of equal parts of depths 0 and 1, by the share `moment_bias`.
[[nodiscard]] Moments biased(const Moments& moments, double moment_bias);

/// The light at z: the largest share not nearer than z among all distributions with these moments.
[[nodiscard]] double hamburger_light(const Moments& moments, double z);

/// A bound on how far B is from singular: its least eigenvalue is at least its determinant over the
/// square of half its trace.
[[nodiscard]] double least_eigenvalue(const Moments& moments);

/// Bounds on the light for moments and z that err by `off`: twice the range of the formula over the
/// corners of that box, plus the last roundings.
struct LightBound {
    double low = 0;
    double high = 0;
};
/// The Cholesky decomposition and the roots are exact for moments with a few roundings. Errors e of
/// the moments change the polynomial's coefficients by at most a relative e · 3·|B⁻¹|·|B⁻¹ (1, z,
/// z²)|. Well conditioned means below 1/64.
[[nodiscard]] bool is_well_conditioned(const Moments& moments, double off);
[[nodiscard]] LightBound light_bound(const Moments& moments, double z, double off);

/// Moments in 16 bits: an affine map of them that fills [0, 1] (Peters and Klein).
struct QuantisedMoments {
    [[nodiscard]] static std::array<double, 4> stored(const Moments& moments);
    [[nodiscard]] static Moments moments(const std::array<double, 4>& stored);
    /// For each stored number, the sum of its absolute terms.
    [[nodiscard]] static std::array<double, 4> sizes();
};

} // namespace gnomon::tests
