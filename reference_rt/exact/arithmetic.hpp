#pragma once

#include "reference_rt/exact/contact.hpp"
#include "scene/vec.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

/// Arithmetics for predicates: doubles with a proven error bound, and exact numbers. Each formula
/// is written once, for any arithmetic.
namespace gnomon::reference_rt {

/// An exact number mantissa·2^exponent. Every finite double has this form, and so do sums and
/// products, which is enough for signs of polynomials.
class Dyadic {
public:
    Dyadic() = default;
    /// Precondition: `value` is finite.
    explicit Dyadic(double value);

    [[nodiscard]] int sign() const { return mantissa_.sign(); }

    friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

    /// numerator / denominator within a relative 2^-52; within 2^-1022 on underflow, infinite on
    /// overflow. Precondition: the denominator is not 0.
    [[nodiscard]] static double quotient(const Dyadic& numerator, const Dyadic& denominator);

private:
    using Integer = boost::multiprecision::cpp_int;
    Dyadic(Integer mantissa, int exponent) : mantissa_{std::move(mantissa)}, exponent_{exponent} {}

    Integer mantissa_ = 0;
    int exponent_ = 0;
};

/// u: half the distance from 1 to the next double.
inline constexpr double unit_roundoff = 0x1p-53;

/// A value computed in double, and its permanent: the expression with every term positive.
///
/// `roundings` is the largest number of roundings between an input and the value, counted at
/// compile time: 0 for an input, 1 for a difference of inputs, one more for each operation. Then
///
///     |value − exact| <= γ_k · permanent,   γ_k = ku/(1 − ku),   k = roundings
///
/// as every term of the expanded polynomial is multiplied by at most k factors (1 + e), |e| <= u.
/// Source: docs/truth.md#the-filter.
template <int roundings>
struct Filtered {
    double value = 0;
    double permanent = 0;

    Filtered() = default;
    Filtered(double value_in, double permanent_in) : value{value_in}, permanent{permanent_in} {}
    /// Converts from a type with fewer roundings.
    template <int fewer>
    requires(fewer < roundings) Filtered(const Filtered<fewer>& other)
        : value{other.value},
          permanent{other.permanent}
    {
    }

    /// Bound of |value − exact|. Two units beyond γ_k cover the roundings of the permanent and of
    /// this product.
    [[nodiscard]] double error() const { return (roundings + 2) * unit_roundoff * permanent; }

    /// The exact value's sign, if this value proves it. A permanent of 0 proves zero, as every term
    /// is 0.
    [[nodiscard]] std::optional<Sign> certain_sign() const
    {
        const double bound = error();
        if (value > bound) {
            return 1;
        }
        if (value < -bound) {
            return -1;
        }
        return permanent == 0 ? std::optional<Sign>{0} : std::nullopt;
    }
};

template <int a, int b>
[[nodiscard]] auto operator+(const Filtered<a>& p, const Filtered<b>& q)
{
    return Filtered<std::max(a, b) + 1>{p.value + q.value, p.permanent + q.permanent};
}
template <int a, int b>
[[nodiscard]] auto operator-(const Filtered<a>& p, const Filtered<b>& q)
{
    return Filtered<std::max(a, b) + 1>{p.value - q.value, p.permanent + q.permanent};
}
template <int a, int b>
[[nodiscard]] auto operator*(const Filtered<a>& p, const Filtered<b>& q)
{
    return Filtered<a + b + 1>{p.value * q.value, p.permanent * q.permanent};
}

/// Double arithmetic with error bounds.
struct FilterField {
    [[nodiscard]] static Filtered<0> number(double x) { return {x, std::abs(x)}; }
    /// The permanent of a difference of inputs is |fl(a − b)|. |a| + |b| would make the filter fail
    /// far from the origin.
    [[nodiscard]] static Filtered<1> difference(double a, double b)
    {
        return {a - b, std::abs(a - b)};
    }
};

/// Exact arithmetic.
struct ExactField {
    [[nodiscard]] static Dyadic number(double x) { return Dyadic{x}; }
    [[nodiscard]] static Dyadic difference(double a, double b) { return Dyadic{a} - Dyadic{b}; }
};

template <typename Number>
struct Vec3 {
    Number x, y, z;
};
/// Clang before 17 cannot deduce template arguments of aggregates.
template <typename Number>
Vec3(Number, Number, Number) -> Vec3<Number>;

template <typename Field>
[[nodiscard]] auto vector(const scene::Vec3d& v)
{
    return Vec3{Field::number(v.x), Field::number(v.y), Field::number(v.z)};
}
template <typename Field>
[[nodiscard]] auto difference(const scene::Vec3d& a, const scene::Vec3d& b)
{
    return Vec3{Field::difference(a.x, b.x), Field::difference(a.y, b.y),
                Field::difference(a.z, b.z)};
}
template <typename A, typename B>
[[nodiscard]] auto dot(const Vec3<A>& a, const Vec3<B>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename A, typename B>
[[nodiscard]] auto cross(const Vec3<A>& a, const Vec3<B>& b)
{
    return Vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename A, typename B>
[[nodiscard]] auto operator+(const Vec3<A>& a, const Vec3<B>& b)
{
    return Vec3{a.x + b.x, a.y + b.y, a.z + b.z};
}
template <typename A, typename B>
[[nodiscard]] auto operator*(const A& s, const Vec3<B>& a)
{
    return Vec3{s * a.x, s * a.y, s * a.z};
}

/// Counts of how signs were decided.
struct SignCounts {
    std::uint64_t filtered = 0; ///< by the filter in doubles
    std::uint64_t exact = 0;    ///< by exact arithmetic

    SignCounts& operator+=(const SignCounts& other)
    {
        filtered += other.filtered;
        exact += other.exact;
        return *this;
    }
};

/// Whether no product of the components with coordinates can underflow, which would break the error
/// bound: each is 0 or at least 2^-96. Float32 values are well scaled (docs/truth.md#the-filter).
[[nodiscard]] inline bool is_well_scaled(const scene::Vec3d& v)
{
    // Branch-free, for loops over lanes.
    const auto fits = [](double x) {
        return static_cast<int>(x == 0) | static_cast<int>(std::abs(x) >= 0x1p-96);
    };
    return (fits(v.x) & fits(v.y) & fits(v.z)) != 0;
}

/// The sign of `formula(Field{})` if the filter proves it; always empty if the inputs are not well
/// scaled.
template <typename Formula>
[[nodiscard]] std::optional<Sign> filtered_sign(SignCounts& counts, bool is_well_scaled,
                                                const Formula& formula)
{
    const auto sign = is_well_scaled ? formula(FilterField{}).certain_sign() : std::nullopt;
    counts.filtered += sign ? 1U : 0U;
    return sign;
}
template <typename Formula>
[[nodiscard]] Sign exact_sign(SignCounts& counts, const Formula& formula)
{
    ++counts.exact;
    return formula(ExactField{}).sign();
}
/// The sign of `formula(Field{})`: by the filter if that proves it, else by exact arithmetic.
template <typename Formula>
[[nodiscard]] Sign sign_of(SignCounts& counts, bool is_well_scaled, const Formula& formula)
{
    const auto sign = filtered_sign(counts, is_well_scaled, formula);
    return sign ? *sign : exact_sign(counts, formula);
}

} // namespace gnomon::reference_rt
