#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace gnomon::reference_rt {

/// An exact number mantissa·2^exponent: closed under sum and product, and every finite double is
/// one. A quotient is not, so signs of polynomials can be decided, and nothing else is needed.
class Dyadic {
public:
    Dyadic() = default;
    /// Precondition: `value` is finite.
    explicit Dyadic(double value);

    [[nodiscard]] int sign() const { return mantissa_.sign(); }

    friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

    /// numerator / denominator within 2^-52 of its size; within 2^-1022 where that underflows,
    /// infinite where it overflows. Precondition: the denominator is not 0.
    [[nodiscard]] static double quotient(const Dyadic& numerator, const Dyadic& denominator);

private:
    using Integer = boost::multiprecision::cpp_int;
    Dyadic(Integer mantissa, int exponent) : mantissa_{std::move(mantissa)}, exponent_{exponent} {}

    Integer mantissa_ = 0;
    int exponent_ = 0;
};

} // namespace gnomon::reference_rt
