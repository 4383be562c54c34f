#pragma once

#include "scene/vec.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::methods {

/// The verdicts that a lookup can give.
enum class Verdict : std::uint8_t {
    binary,   ///< 0 or 1
    fraction, ///< those between, too
};

/// What a verdict is made of.
enum class Compares : std::uint8_t {
    each_tap,   ///< each tap's depth with the receiver's: the verdict is the share, by weight, of
                ///< lit taps
    mean_depth, ///< the mean, by weight, of the taps' depths with the receiver's: one comparison
    primitives, ///< the triangle that a texel shows with the receiver's: one comparison
    none,       ///< no comparison
};

/// Whether a verdict can only rise when the constant bias does.
enum class Monotone : std::uint8_t {
    exactly,        ///< it never falls
    up_to_rounding, ///< it falls by rounding errors alone
    no,
};

/// A promise about rising, with its size where it has one.
struct Monotonicity {
    Monotone how = Monotone::exactly;
    double largest_fall = 0; ///< of a verdict [0, 1]; 0 unless `how` is `up_to_rounding`

    friend bool operator==(const Monotonicity&, const Monotonicity&) = default;
};

/// How the critical bias of a pixel is found.
enum class Curve : std::uint8_t {
    by_formula,   ///< from one lookup, for every constant bias
    by_bisection, ///< GL itself, asked with biases of its own at each pixel
    none,         ///< not at all: GL looks up again for each bias that is asked for
};

/// How much each tap counts.
enum class Weights : std::uint8_t {
    equal,
    bilinear,       ///< by the place between texel centres
    bilinear_of_gl, ///< the same, as a driver rounds it: the map's answers to other biases are GL's
                    ///< own
    of_taps         ///< each of `ScatteredTaps` its own, and its place between texel centres
};

/// The triangles whose shadows a verdict without a map is made of.
enum class Casters : std::uint8_t {
    all,
    facing_light, ///< those whose corners the light sees counter-clockwise
};

/// Which texels a verdict can depend on.
enum class Reads : std::uint8_t {
    footprint, ///< those of its footprint alone
    whole_map, ///< any
};

/// Weights along the columns, and along the rows, of a square of texels: how much each counts is
/// its share of their sum, which is 1, or whole where they are whole. They stand for ever: a
/// table's.
struct Kernel {
    std::span<const float> weights; ///< of an odd number; empty: of one texel

    [[nodiscard]] constexpr int width_texels() const
    {
        return weights.empty() ? 1 : static_cast<int>(weights.size());
    }
    friend bool operator==(const Kernel& a, const Kernel& b)
    {
        return std::ranges::equal(a.weights, b.weights);
    }
};

/// Taps that lie anywhere about the point that is looked up, in place of a square of texels. A
/// lookup hands out its kernel's axis a, radius and turn of it in texels; the tap at (x, y) reads
/// the texel that holds
///
///     uv · resolution + (fl(x · a.x) − fl(y · a.y), fl(x · a.y) + fl(y · a.x))
///
/// each sum rounded to float32. Interpolated ones read the four texels whose centres are nearest to
/// that point in its place, and mix what they say bilinearly: the four follow each other, row by
/// row from the lower left. Places and weights stand for ever: a table's.
struct ScatteredTaps {
    std::span<const scene::Vec2f> places = {}; ///< in a kernel of radius 1, the one nearest to its
                                               ///< middle first; empty: taps are not scattered
    std::span<const float> weights = {}; ///< whole multiples of 2^-16 that sum to 1; empty: equal
    bool are_interpolated = false;       ///< each is four texels
    double radius = 0;                   ///< of the kernel [texels]
    bool is_in_metres = false;           ///< it is: [m] at the receiver, and limited in texels
    bool is_turned = false;              ///< by an angle of each pixel's own

    friend bool operator==(const ScatteredTaps& a, const ScatteredTaps& b)
    {
        return std::ranges::equal(a.places, b.places) && std::ranges::equal(a.weights, b.weights) &&
               a.are_interpolated == b.are_interpolated && a.radius == b.radius &&
               a.is_in_metres == b.is_in_metres && a.is_turned == b.is_turned;
    }
    /// Texels that a lookup reads, those of one place one after the other.
    [[nodiscard]] constexpr std::size_t texel_count() const
    {
        return places.size() * (are_interpolated ? 4 : 1);
    }
};

/// No footprint has more texels than this: a kernel of 9 × 9, interpolated.
inline constexpr std::size_t most_taps = 100;

/// What a method promises of the lookups of a job. Ask this, not which method or filter it is.
struct LookupTraits {
    Verdict verdict = Verdict::binary;
    Compares compares = Compares::each_tap;
    Monotonicity monotonicity;
    Curve curve = Curve::by_formula;
    /// The footprint: the square of so many level-0 texels across that are a verdict's taps, or
    /// that scattered ones lie in; of a radius in metres the least.
    int width_texels = 1;
    Weights weights = Weights::equal;
    /// What `weights` interpolates: means by this kernel. With `equal` it is empty.
    Kernel kernel;
    ScatteredTaps taps = {};
    Reads reads = Reads::footprint;
    int samples = 1; ///< depths of each of them: at its centre, or several at the driver's samples
    int layers = 1;  ///< surfaces of each that count: the first, or the second behind it, too
    std::uint64_t map_bytes = 0;    ///< memory that the map takes; 0 without a map
    bool has_map = true;            ///< else nothing is drawn from the light
    Casters casters = Casters::all; ///< without a map
    bool mixes_maps = false;        ///< the verdict is mixed of two maps' (`mixed`)

    friend bool operator==(const LookupTraits&, const LookupTraits&) = default;

    [[nodiscard]] constexpr std::size_t tap_count() const
    {
        const auto width = static_cast<std::size_t>(width_texels);
        return taps.places.empty() ? width * width : taps.texel_count();
    }
    /// Whether the verdict depends on one texel.
    [[nodiscard]] constexpr bool has_one_tap() const { return width_texels == 1 && !mixes_maps; }
    /// Whether a verdict can lie between 0 and 1.
    [[nodiscard]] constexpr bool has_fractions() const { return verdict == Verdict::fraction; }
    /// Whether taps lie around the point looked up, and not about the texel that holds it.
    [[nodiscard]] constexpr bool interpolates() const
    {
        return weights == Weights::bilinear || weights == Weights::bilinear_of_gl;
    }
    /// Whether taps count by their weights.
    [[nodiscard]] constexpr bool weighs_taps() const { return weights != Weights::equal; }
    /// Whether taps lie anywhere, and not in a square of texels.
    [[nodiscard]] constexpr bool scatters_taps() const { return !taps.places.empty(); }
    /// Whether the verdict is the share of taps that are lit.
    [[nodiscard]] constexpr bool is_made_of_taps() const { return compares == Compares::each_tap; }
    /// Whether the verdict is made of depths that are compared.
    [[nodiscard]] constexpr bool compares_depths() const
    {
        return compares == Compares::each_tap || compares == Compares::mean_depth;
    }
    /// Whether causes follow from what exact rays hit, without running the method again.
    [[nodiscard]] constexpr bool has_exact_causes() const
    {
        return compares != Compares::none || !has_map;
    }
    /// Whether each verdict follows from one depth that the lookup returns.
    [[nodiscard]] constexpr bool returns_deciding_depth() const
    {
        return compares == Compares::mean_depth || (is_made_of_taps() && has_one_tap());
    }
    /// Whether every constant bias is known.
    [[nodiscard]] constexpr bool has_curve() const { return curve != Curve::none; }
    /// Whether every constant bias follows from one lookup.
    [[nodiscard]] constexpr bool has_formula() const { return curve == Curve::by_formula; }
    /// Comparisons of equal weight that make a verdict: of a binary one 1; 0 where weights are not
    /// equal, or a fraction is made of no comparisons.
    [[nodiscard]] constexpr int equal_taps() const
    {
        if (verdict == Verdict::binary) {
            return 1;
        }
        return is_made_of_taps() && weights == Weights::equal ? static_cast<int>(tap_count()) : 0;
    }
};

/// The largest radius of a kernel [texels].
inline constexpr double largest_radius_texels = 64;

/// The width of what a kernel of this radius can read [texels]: the texel in the middle, and on
/// either side of it as many as it reaches into.
[[nodiscard]] int width_of_radius(double radius_texels);

/// Of verdicts that are mixed of two maps': they lie between both, rise where both do, and follow
/// from no comparison that one lookup returns. The footprint is that of one of the maps.
[[nodiscard]] LookupTraits mixed(LookupTraits promised);

/// Each value as results and documents spell it: "each_tap".
[[nodiscard]] std::string_view name(Verdict verdict);
[[nodiscard]] std::string_view name(Compares compares);
[[nodiscard]] std::string_view name(Monotone rise);
[[nodiscard]] std::string_view name(Curve curve);
[[nodiscard]] std::string_view name(Reads reads);

} // namespace gnomon::methods
