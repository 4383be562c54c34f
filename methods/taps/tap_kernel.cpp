#include "methods/taps/tap_kernel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>

namespace gnomon::methods {
namespace {

using scene::Vec2d;
using scene::Vec2f;

/// e^(i·φ), in doubles that are written out: a machine's sine may differ in its last bit.
constexpr std::complex<double> golden_turn{-0.7373688780783197, 0.6754902942615238};
constexpr std::complex<double> rotation_step{0.9951847266721969, 0.0980171403295606};

/// The product, each term rounded by itself.
std::complex<double> turned(const std::complex<double>& a, const std::complex<double>& by)
{
    return {a.real() * by.real() - a.imag() * by.imag(),
            a.real() * by.imag() + a.imag() * by.real()};
}

/// Of a grid the taps on either side of its middle.
int half_of_grid(int taps)
{
    return static_cast<int>(std::lround(std::sqrt(static_cast<double>(taps)))) / 2;
}

std::vector<Vec2f> grid_places(int taps)
{
    const int half = half_of_grid(taps);
    const auto share = [&](int i) { return static_cast<float>(i) / static_cast<float>(half); };
    std::vector<Vec2f> places{Vec2f{0}};
    for (int y = -half; y <= half; ++y) {
        for (int x = -half; x <= half; ++x) {
            if (x != 0 || y != 0) {
                places.emplace_back(share(x), share(y));
            }
        }
    }
    return places;
}

/// On a spiral of golden angles, the i-th at √((i + first) / last).
std::vector<Vec2f> spiral_places(int taps, double first, double last)
{
    std::vector<Vec2f> places;
    std::complex<double> turn{1, 0};
    for (int i = 0; i < taps; ++i) {
        const double radius = std::sqrt((static_cast<double>(i) + first) / last);
        places.emplace_back(Vec2d{radius * turn.real(), radius * turn.imag()});
        turn = turned(turn, golden_turn);
    }
    return places;
}

/// Numbers without a pattern (xorshift64*), the same ones each time.
class Numbers {
public:
    /// In [−1, 1), a multiple of 2^-23.
    float next()
    {
        state_ ^= state_ >> 12U;
        state_ ^= state_ << 25U;
        state_ ^= state_ >> 27U;
        const std::uint64_t number = state_ * 0x2545F4914F6CDD1DU;
        return static_cast<float>(number >> 40U) * 0x1p-23F - 1;
    }

private:
    std::uint64_t state_ = 0x9E3779B97F4A7C15U;
};

double square_distance(const Vec2f& a, const Vec2f& b)
{
    const Vec2d between = Vec2d{a} - Vec2d{b};
    return between.x * between.x + between.y * between.y;
}

Vec2f place_in_disc(Numbers& numbers)
{
    for (;;) {
        const float x = numbers.next();
        const float y = numbers.next();
        if (square_distance({x, y}, Vec2f{0}) <= 1) {
            return {x, y};
        }
    }
}

/// Each the best of many tries: the one that is farthest from all before.
std::vector<Vec2f> poisson_places(int taps)
{
    constexpr int tries = 256;
    Numbers numbers;
    std::vector<Vec2f> places{Vec2f{0}};
    while (places.size() < static_cast<std::size_t>(taps)) {
        Vec2f best{0};
        double best_distance = -1;
        for (int i = 0; i < tries; ++i) {
            const Vec2f place = place_in_disc(numbers);
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vec2f& other : places) {
                nearest = std::min(nearest, square_distance(place, other));
            }
            if (nearest > best_distance) {
                best = place;
                best_distance = nearest;
            }
        }
        places.push_back(best);
    }
    return places;
}

std::vector<Vec2f> places_of(TapPattern pattern, int taps)
{
    switch (pattern) {
    case TapPattern::grid:
        return grid_places(taps);
    case TapPattern::poisson:
        return poisson_places(taps);
    case TapPattern::vogel:
        return spiral_places(taps, 0, taps - 1);
    case TapPattern::vogel_areas:
        return spiral_places(taps, 0.5, taps);
    }
    return {};
}

/// A tap's weight before all are scaled.
double weight_at(const Vec2f& place, TapPattern pattern, int taps, TapWeights weights)
{
    const double distance = std::sqrt(square_distance(place, Vec2f{0}));
    if (weights == TapWeights::gaussian) {
        return std::exp(-2 * distance * distance);
    }
    // Of a grid 1 + 1/half: the next tap outwards would have none.
    const double reach = 1 + 2 / (std::sqrt(static_cast<double>(taps)) - 1);
    const auto falls = [&](double from_middle) { return 1 - std::abs(from_middle) / reach; };
    return pattern == TapPattern::grid ? falls(double{place.x}) * falls(double{place.y})
                                       : falls(distance);
}

/// Whole multiples of 2^-16: what rounding leaves is the middle's.
std::vector<float> weights_of(const std::vector<Vec2f>& places, TapPattern pattern, int taps,
                              TapWeights weights)
{
    if (weights == TapWeights::equal) {
        return {};
    }
    std::vector<double> exact;
    double sum = 0;
    for (const Vec2f& place : places) {
        exact.push_back(weight_at(place, pattern, taps, weights));
        sum += exact.back();
    }
    constexpr double unit = 0x1p-16;
    std::vector<float> rounded;
    double rest = 1;
    for (const double weight : exact) {
        const double whole = std::round(weight / sum / unit) * unit;
        rounded.push_back(static_cast<float>(whole));
        rest -= whole;
    }
    rounded.front() += static_cast<float>(rest);
    return rounded;
}

} // namespace

bool is_grid(int taps)
{
    const int across = 2 * half_of_grid(taps) + 1;
    return taps > 1 && across * across == taps;
}

const TapKernel& tap_kernel(TapPattern pattern, int taps, TapWeights weights)
{
    if (taps < least_kernel_taps || taps > most_kernel_taps ||
        (pattern == TapPattern::grid && !is_grid(taps))) {
        throw std::invalid_argument(fmt::format("tap_kernel: taps: there is none of {}", taps));
    }
    using Name = std::tuple<TapPattern, int, TapWeights>;
    static std::mutex mutex;
    static std::map<Name, TapKernel> kernels;
    const std::scoped_lock lock{mutex};
    const auto [kernel, is_new] = kernels.try_emplace(Name{pattern, taps, weights});
    if (is_new) {
        kernel->second.places = places_of(pattern, taps);
        kernel->second.weights = weights_of(kernel->second.places, pattern, taps, weights);
    }
    return kernel->second;
}

std::span<const Vec2f> rotations()
{
    static const auto table = [] {
        std::array<Vec2f, rotation_count> all;
        std::complex<double> turn{1, 0};
        for (Vec2f& rotation : all) {
            rotation = Vec2f{Vec2d{turn.real(), turn.imag()}};
            turn = turned(turn, rotation_step);
        }
        return all;
    }();
    return table;
}

} // namespace gnomon::methods
