#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

/// That a mean of 2 × 2 comparisons never falls when one of them turns from shadowed to lit,
/// however a driver computes it in float32: what the promise of `hardware` rests on.
namespace gnomon::methods {
namespace {

using Taps = std::array<float, 4>; ///< (0,0) (1,0) (0,1) (1,1): 0 or 1 each

/// As Mesa's llvmpipe does it.
float interpolated(const Taps& taps, float x, float y)
{
    const auto between = [](float a, float b, float weight) { return a + weight * (b - a); };
    return between(between(taps[0], taps[1], x), between(taps[2], taps[3], x), y);
}

/// As GL's specification writes it.
float summed(const Taps& taps, float x, float y)
{
    return (1 - x) * (1 - y) * taps[0] + x * (1 - y) * taps[1] + (1 - x) * y * taps[2] +
           x * y * taps[3];
}

TEST(BilinearComparison, NeverFallsWhenATapIsLit)
{
    std::mt19937 random{1};
    for (int i = 0; i < 250'000; ++i) {
        // Fractions of so many bits, most of them near 0, ½ or 1, where an error would show.
        const std::uint_fast32_t all = 1U << (8 + random() % 16);
        const auto fraction = [&] {
            const std::uint_fast32_t near = random() % 32;
            const std::array<std::uint_fast32_t, 4> choices{random() % all, all / 2 - near,
                                                            all - 1 - near, near};
            return static_cast<float>(choices.at(random() % 4)) / static_cast<float>(all);
        };
        const float x = fraction();
        const float y = fraction();
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        std::shuffle(order.begin(), order.end(), random);
        Taps taps{};
        for (const std::size_t next : order) {
            const float before = interpolated(taps, x, y);
            const float sum_before = summed(taps, x, y);
            taps.at(next) = 1;
            ASSERT_GE(interpolated(taps, x, y), before) << "x " << x << " y " << y;
            ASSERT_GE(summed(taps, x, y), sum_before) << "x " << x << " y " << y;
        }
    }
}

} // namespace
} // namespace gnomon::methods
