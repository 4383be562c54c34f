#include "reference_rt/exact/arithmetic.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

namespace gnomon::reference_rt {

Dyadic::Dyadic(double value)
{
    assert(std::isfinite(value));
    if (value == 0) {
        return;
    }
    int exponent = 0;
    const auto digits = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    // Dropping trailing zeros keeps products short: float32 values have at most 24 bits.
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(digits));
    mantissa_ = digits >> zeros;
    exponent_ = exponent - 53 + zeros;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b)
{
    if (a.sign() == 0 || b.sign() == 0) {
        return a.sign() == 0 ? b : a;
    }
    const bool a_is_finer = a.exponent_ <= b.exponent_;
    const Dyadic& fine = a_is_finer ? a : b;
    const Dyadic& coarse = a_is_finer ? b : a;
    Dyadic::Integer sum = coarse.mantissa_;
    sum <<= static_cast<unsigned>(coarse.exponent_ - fine.exponent_);
    sum += fine.mantissa_;
    return {std::move(sum), fine.exponent_};
}

Dyadic operator-(const Dyadic& a, const Dyadic& b)
{
    return a + Dyadic{-b.mantissa_, b.exponent_};
}

Dyadic operator*(const Dyadic& a, const Dyadic& b)
{
    return {a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_};
}

double Dyadic::quotient(const Dyadic& numerator, const Dyadic& denominator)
{
    assert(denominator.sign() != 0);
    if (numerator.sign() == 0) {
        return 0;
    }
    Integer top = abs(numerator.mantissa_);
    const Integer bottom = abs(denominator.mantissa_);
    // Computes 62 or 63 quotient bits, so that truncation costs less than the rounding to double.
    const int shift = 62 + static_cast<int>(msb(bottom)) - static_cast<int>(msb(top));
    if (shift >= 0) {
        top <<= static_cast<unsigned>(shift);
    } else {
        top >>= static_cast<unsigned>(-shift);
    }
    const Integer ratio = top / bottom;
    const auto digits = static_cast<double>(ratio.convert_to<std::uint64_t>());
    const double size = std::ldexp(digits, numerator.exponent_ - denominator.exponent_ - shift);
    return numerator.sign() == denominator.sign() ? size : -size;
}

} // namespace gnomon::reference_rt
