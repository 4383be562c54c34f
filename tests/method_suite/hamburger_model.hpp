#pragma once

#include "scene/vec.hpp"

#include <array>

namespace gnomon::tests {

/// The first four moments of depths; Hankel's matrix of them is B.
using Moments = scene::Vec4d;

/// Moved towards those of depths 0 and 1 alike by the share `moment_bias`.
[[nodiscard]] Moments biased(const Moments& moments, double moment_bias);

/// The share of light at z: of all distributions with these moments the greatest that is not
/// nearer.
[[nodiscard]] double hamburger_light(const Moments& moments, double z);

/// How little B differs from a matrix that is none of a distribution: its least eigenvalue is at
/// least its determinant over the square of half its trace.
[[nodiscard]] double least_eigenvalue(const Moments& moments);

/// Between what the share of light is, of moments and z that are off by `off`: twice what the
/// formula makes of the corners of that box, and what rounds last.
struct LightBound {
    double low = 0;
    double high = 0;
};
/// Cholesky's decomposition and the roots are those of moments that are off by some roundings. What
/// moments that are off by e do to the verdict is at most e times 3·|B⁻¹|·|B⁻¹ (1, z, z²)|, by
/// which the polynomial's coefficients change, in parts of them: taken where that is below 1/64.
[[nodiscard]] bool is_well_conditioned(const Moments& moments, double off);
[[nodiscard]] LightBound light_bound(const Moments& moments, double z, double off);

/// What 16 bits hold of moments: an affine map of them that fills [0, 1] (Peters and Klein).
struct QuantisedMoments {
    [[nodiscard]] static std::array<double, 4> stored(const Moments& moments);
    [[nodiscard]] static Moments moments(const std::array<double, 4>& stored);
    /// Of each stored number, the sum of the sizes that are added up.
    [[nodiscard]] static std::array<double, 4> sizes();
};

} // namespace gnomon::tests
