#include "reference_rt/exact/interval.hpp"

#include <boost/multiprecision/gmp.hpp>
#include <gtest/gtest.h>

#include <random>

namespace gnomon::reference_rt::test {
namespace {

using Rational = boost::multiprecision::mpq_rational;

/// A number in interval, double-double and exact arithmetic.
struct Triple {
    Interval bounded;
    DoubleDouble wide;
    Rational exact;
};
Triple operator+(const Triple& a, const Triple& b)
{
    return {a.bounded + b.bounded, a.wide + b.wide, a.exact + b.exact};
}
Triple operator-(const Triple& a, const Triple& b)
{
    return {a.bounded - b.bounded, a.wide - b.wide, a.exact - b.exact};
}
Triple operator*(const Triple& a, const Triple& b)
{
    return {a.bounded * b.bounded, a.wide * b.wide, a.exact * b.exact};
}

/// A number of up to `bits` bits, of any size between 2^-20 and 2^20.
double random_number(std::mt19937_64& random, int bits)
{
    const auto mantissa = static_cast<double>(random() >> (64 - bits));
    const int exponent = static_cast<int>(random() % 41) - 20;
    return std::ldexp((random() & 1U) != 0 ? mantissa : -mantissa, exponent - bits);
}
Triple random_triple(std::mt19937_64& random)
{
    const double x = random_number(random, 24 + static_cast<int>(random() % 30));
    return {{x, 0}, DoubleDoubleField::number(x), Rational{x}};
}

void expect_bounds_hold(const Triple& triple)
{
    EXPECT_LE(abs(triple.exact - Rational{triple.bounded.value}), Rational{triple.bounded.error});
    EXPECT_LE(Rational{triple.bounded.lower()}, triple.exact);
    EXPECT_GE(Rational{triple.bounded.upper()}, triple.exact);
    EXPECT_LE(abs(triple.exact - Rational{triple.wide.high} - Rational{triple.wide.low}),
              Rational{triple.wide.error});
    const Interval rounded = triple.wide.rounded();
    EXPECT_LE(abs(triple.exact - Rational{rounded.value}), Rational{rounded.error});
}

TEST(Interval, HoldsForSumsAndProductsThatCancel)
{
    constexpr unsigned seed = 5;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random{seed};
    for (int i = 0; i < 20'000; ++i) {
        const Triple a = random_triple(random);
        const Triple b = random_triple(random);
        const Triple c = random_triple(random);
        // (a + b)·c − a·c − b·c is exactly 0, and near it what is left when a bit is added.
        expect_bounds_hold((a + b) * c - a * c - b * c);
        expect_bounds_hold((a * b - c) * (a - b * c) - random_triple(random));
    }
}

TEST(Interval, HoldsForQuotients)
{
    constexpr unsigned seed = 6;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random{seed};
    for (int i = 0; i < 20'000; ++i) {
        const Triple a = random_triple(random) * random_triple(random) - random_triple(random);
        const Triple b = random_triple(random) * random_triple(random) - random_triple(random);
        const Interval quotient = a.bounded / b.bounded;
        if (std::isfinite(quotient.error)) {
            EXPECT_LE(abs(a.exact / b.exact - Rational{quotient.value}), Rational{quotient.error});
        }
    }
}

TEST(Interval, KnowsNothingOfAQuotientByWhatMayBeZero)
{
    const Interval quotient = Interval{1, 0} / Interval{1, 1};
    EXPECT_FALSE(quotient.is_certainly_positive() || quotient.is_certainly_negative());
    const Interval nothing = Interval{0, 0} / Interval{0, 0};
    EXPECT_FALSE(nothing.is_certainly_positive() || nothing.is_certainly_negative());
}

TEST(DoubleDouble, IsAFewRoundingsFromTheExactSum)
{
    // 2^60 + 1 − 2^60: double alone loses the 1.
    const DoubleDouble sum = DoubleDoubleField::number(0x1p60) + DoubleDoubleField::number(1) -
                             DoubleDoubleField::number(0x1p60);
    EXPECT_EQ(sum.high, 1);
    EXPECT_LE(sum.error, 0x1p-40);
    EXPECT_EQ(DoubleDoubleField::difference(1, 0x1p-70).low, -0x1p-70);
}

TEST(DoubleDouble, QuotientsHoldTheirBounds)
{
    constexpr unsigned seed = 8;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random{seed};
    for (int i = 0; i < 20'000; ++i) {
        const Triple a = random_triple(random) * random_triple(random) - random_triple(random);
        const Triple b = random_triple(random) * random_triple(random) - random_triple(random);
        const DoubleDouble quotient = a.wide / b.wide;
        if (!std::isfinite(quotient.error)) {
            continue;
        }
        const Rational exact = a.exact / b.exact;
        EXPECT_LE(abs(exact - Rational{quotient.high} - Rational{quotient.low}),
                  Rational{quotient.error})
            << "case " << i;
        // The operands lose 2^-103 of terms below 2^40, of which a quotient by |b| makes 2^-63/|b|
        // and |q| times that.
        EXPECT_LE(quotient.error, (1 + std::abs(quotient.high)) * 0x1p-58 / std::abs(b.wide.high))
            << "case " << i;
    }
}

TEST(DoubleDouble, KnowsNothingOfAQuotientByWhatMayBeZero)
{
    EXPECT_FALSE(std::isfinite((DoubleDouble{1, 0, 0} / DoubleDouble{1, 0, 1}).error));
    EXPECT_FALSE(std::isfinite((DoubleDouble{0, 0, 0} / DoubleDouble{0, 0, 0}).error));
}

TEST(CompensatedDot, RoundsOnceHoweverItCancels)
{
    constexpr unsigned seed = 7;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random{seed};
    for (int i = 0; i < 20'000; ++i) {
        std::array<double, 4> a{};
        std::array<double, 4> b{};
        Rational exact = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            a[k] = random_number(random, 24);
            b[k] = k == 3 ? -exact.convert_to<double>() / (a[k] == 0 ? 1 : a[k])
                          : random_number(random, 53);
            exact += Rational{a[k]} * Rational{b[k]};
        }
        const Interval dot = compensated_dot<4>(a, b);
        EXPECT_LE(abs(exact - Rational{dot.value}), Rational{dot.error});
        // One rounding, and 2^-99 of terms below 2^42.
        EXPECT_LE(dot.error, 0x1p-52 * std::abs(dot.value) + 0x1p-55);
    }
}

} // namespace
} // namespace gnomon::reference_rt::test
