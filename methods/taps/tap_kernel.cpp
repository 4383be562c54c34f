#include "methods/taps/tap_kernel.hpp"

#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <tuple>
#include <variant>

namespace gnomon::methods {
namespace {

using scene::Vec2d;
using scene::Vec2f;

/// e^(i·φ) as literal doubles, because sines differ between machines in the last bit.
constexpr std::complex<double> golden_turn{-0.7373688780783197, 0.6754902942615238};
constexpr std::complex<double> rotation_step{0.9951847266721969, 0.0980171403295606};

/// The product, with each term rounded separately.
std::complex<double> turned(const std::complex<double>& a, const std::complex<double>& by)
{
    return {a.real() * by.real() - a.imag() * by.imag(),
            a.real() * by.imag() + a.imag() * by.real()};
}

/// The number of a grid's taps on either side of its middle.
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

/// Places on a spiral of golden angles; the i-th has radius √((i + first) / last).
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

/// A deterministic random generator (xorshift64*).
class Numbers {
public:
    /// The next number in [−1, 1), a multiple of 2^-23.
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

/// Best candidates: each place is the farthest from all previous ones among many tries.
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

/// A tap's weight before normalisation.
double weight_at(const Vec2f& place, TapPattern pattern, int taps, TapWeights weights)
{
    const double distance = std::sqrt(square_distance(place, Vec2f{0}));
    if (weights == TapWeights::gaussian) {
        return std::exp(-2 * distance * distance);
    }
    // 1 + 1/half for a grid: the next tap outwards would have weight 0.
    const double reach = 1 + 2 / (std::sqrt(static_cast<double>(taps)) - 1);
    const auto falls = [&](double from_middle) { return 1 - std::abs(from_middle) / reach; };
    return pattern == TapPattern::grid ? falls(double{place.x}) * falls(double{place.y})
                                       : falls(distance);
}

/// Weights as multiples of 2^-16; the middle tap absorbs the rounding.
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
        throw std::invalid_argument(fmt::format("tap_kernel: taps: no kernel has {}", taps));
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

using scene::Key;
using scene::Stage;

const Key& pattern_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.pattern",
                        "how taps lie: in rows and columns, anywhere far from each other, or on a "
                        "spiral, from its middle on or in the middle of equal areas",
                        "", scene::only(Stage::lookup)),
        scene::WordDomain{.words = {"grid", "poisson", "vogel", "vogel_areas"}},
        std::string{"grid"}, {.values = {std::string{"poisson"}, std::string{"vogel"}}});
    return key;
}

const Key& taps_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.taps", "{unit} of a kernel; of a grid 9, 25, 49 or 81", "",
                        scene::only(Stage::lookup), "taps"),
        scene::IntegerDomain{.lower = least_kernel_taps, .upper = most_kernel_taps},
        std::int64_t{25}, {.values = {std::int64_t{9}, std::int64_t{49}}});
    return key;
}

const Key& turned_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.turned",
                        "turns each pixel's kernel by an angle that a hash of the pixel gives", "",
                        scene::only(Stage::lookup)),
        scene::FlagDomain{}, false, {.values = {true}});
    return key;
}

TapPattern tap_pattern(const scene::Job& job)
{
    const auto& word = std::get<std::string>(pattern_key().value_of(job.method));
    return word == "grid"      ? TapPattern::grid
           : word == "poisson" ? TapPattern::poisson
           : word == "vogel"   ? TapPattern::vogel
                               : TapPattern::vogel_areas;
}

int tap_count(const scene::Job& job)
{
    return static_cast<int>(std::get<std::int64_t>(taps_key().value_of(job.method)));
}

bool is_turned(const scene::Job& job)
{
    return std::get<bool>(turned_key().value_of(job.method));
}

const TapKernel& tap_kernel(const scene::Job& job, TapWeights weights)
{
    constexpr int smallest_grid = 9;
    const TapPattern pattern = tap_pattern(job);
    const int taps = tap_count(job);
    const bool is_none = pattern == TapPattern::grid && !is_grid(taps);
    return tap_kernel(pattern, is_none ? smallest_grid : taps, weights);
}

void check_taps(const scene::Job& job)
{
    const int taps = tap_count(job);
    if (tap_pattern(job) == TapPattern::grid && !is_grid(taps)) {
        throw scene::InputError(fmt::format(
            "method.taps = {}: a grid has an odd number of taps along each side; use 9, 25, 49 or "
            "81, or another method.pattern",
            taps));
    }
}

} // namespace gnomon::methods
