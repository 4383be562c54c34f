#pragma once

#include "scene/vec.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::methods {

/// The possible verdicts of a lookup.
enum class Verdict : std::uint8_t {
    binary,   ///< 0 or 1
    fraction, ///< values between 0 and 1, too
};

/// What a lookup compares.
enum class Compares : std::uint8_t {
    each_tap,   ///< each tap's depth with the receiver's: the verdict is the weighted share of
                ///< lit taps
    mean_depth, ///< the weighted mean of the taps' depths with the receiver's: one comparison
    primitives, ///< a texel's triangle with the receiver's: one comparison
    none,       ///< no comparison
};

/// Whether the verdict rises monotonically with the constant bias.
enum class Monotone : std::uint8_t {
    exactly,        ///< it never falls
    up_to_rounding, ///< it falls only by rounding errors
    no,
};

/// How monotone a verdict is, with the largest violation.
struct Monotonicity {
    Monotone how = Monotone::exactly;
    double largest_fall = 0; ///< of a verdict [0, 1]; 0 unless `how` is `up_to_rounding`

    friend bool operator==(const Monotonicity&, const Monotonicity&) = default;
};

/// How the critical bias of a pixel is found.
enum class Curve : std::uint8_t {
    by_formula,   ///< from one lookup, for every constant bias
    by_bisection, ///< by GL lookups with a bias per pixel
    none,         ///< unknown: each bias needs another GL lookup
};

/// The weights of taps.
enum class Weights : std::uint8_t {
    equal,
    bilinear,       ///< by the position between texel centres
    bilinear_of_gl, ///< likewise, rounded by the driver: the answers for other biases are GL's
                    ///< own
    of_taps         ///< each of `ScatteredTaps` its own, and its place between texel centres
};

/// The triangles that cast shadows in a method without a map.
enum class Casters : std::uint8_t {
    all,
    facing_light, ///< those whose corners the light sees counter-clockwise
};

/// The texels that a verdict can depend on.
enum class Reads : std::uint8_t {
    footprint, ///< those of its footprint
    whole_map, ///< all
};

/// Weights along the rows and columns of a square of texels. A texel's share is its weight over the
/// sum, which is 1, or an integer for integer weights. Points into a static table.
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

/// Taps at arbitrary positions around the lookup point, instead of a square of texels. A lookup
/// returns its kernel's axis a, which holds radius and rotation in texels. The tap at (x, y) reads
/// the texel that holds
///
///     uv · resolution + (fl(x · a.x) − fl(y · a.y), fl(x · a.y) + fl(y · a.x))
///
/// each sum rounded to float32. An interpolated tap reads the four texels whose centres are nearest
/// to that point and blends their answers bilinearly; the four are listed row by row from the lower
/// left. Points into static tables.
struct ScatteredTaps {
    std::span<const scene::Vec2f> places = {}; ///< in a kernel of radius 1, the one nearest to its
                                               ///< middle first; empty: taps are not scattered
    std::span<const float> weights = {}; ///< whole multiples of 2^-16 that sum to 1; empty: equal
    bool are_interpolated = false;       ///< each tap reads four texels
    double radius = 0;                   ///< of the kernel [texels]
    bool is_in_metres = false; ///< the radius is in metres at the receiver, limited in texels
    bool is_turned = false;    ///< rotated by an angle per pixel

    friend bool operator==(const ScatteredTaps& a, const ScatteredTaps& b)
    {
        return std::ranges::equal(a.places, b.places) && std::ranges::equal(a.weights, b.weights) &&
               a.are_interpolated == b.are_interpolated && a.radius == b.radius &&
               a.is_in_metres == b.is_in_metres && a.is_turned == b.is_turned;
    }
    /// Number of texels that a lookup reads.
    [[nodiscard]] constexpr std::size_t texel_count() const
    {
        return places.size() * (are_interpolated ? 4 : 1);
    }
};

/// Most texels of a footprint: an interpolated kernel of 9 × 9.
inline constexpr std::size_t most_taps = 100;

/// The traits of a job's lookups. Use these instead of asking for the method or filter.
struct LookupTraits {
    Verdict verdict = Verdict::binary;
    Compares compares = Compares::each_tap;
    Monotonicity monotonicity;
    Curve curve = Curve::by_formula;
    /// The footprint: width of the square of level-0 texels that holds all taps. For a radius in
    /// metres, the least width.
    int width_texels = 1;
    Weights weights = Weights::equal;
    /// The kernel whose means `weights` interpolates; empty with `equal`.
    Kernel kernel;
    ScatteredTaps taps = {};
    Reads reads = Reads::footprint;
    int samples = 1; ///< depths per texel: at its centre, or at the driver's sample positions
    int layers = 1;  ///< surfaces per texel: 1, or 2 with the second one behind
    std::uint64_t map_bytes = 0;    ///< memory of the map; 0 without a map
    bool has_map = true;            ///< if false, nothing is drawn from the light
    Casters casters = Casters::all; ///< without a map
    bool mixes_maps = false;        ///< the verdict may blend those of two maps (`mixed`)

    friend bool operator==(const LookupTraits&, const LookupTraits&) = default;

    [[nodiscard]] constexpr std::size_t tap_count() const
    {
        const auto width = static_cast<std::size_t>(width_texels);
        return taps.places.empty() ? width * width : taps.texel_count();
    }
    /// Whether the verdict depends on a single texel.
    [[nodiscard]] constexpr bool has_one_tap() const { return width_texels == 1 && !mixes_maps; }
    /// Whether a verdict can lie between 0 and 1.
    [[nodiscard]] constexpr bool has_fractions() const { return verdict == Verdict::fraction; }
    /// Whether taps lie around the lookup point, not around the texel that holds it.
    [[nodiscard]] constexpr bool interpolates() const
    {
        return weights == Weights::bilinear || weights == Weights::bilinear_of_gl;
    }
    /// Whether taps have different weights.
    [[nodiscard]] constexpr bool weighs_taps() const { return weights != Weights::equal; }
    /// Whether taps are scattered, not in a square of texels.
    [[nodiscard]] constexpr bool scatters_taps() const { return !taps.places.empty(); }
    /// Whether the verdict is the share of lit taps.
    [[nodiscard]] constexpr bool is_made_of_taps() const { return compares == Compares::each_tap; }
    /// Whether the lookup compares depths.
    [[nodiscard]] constexpr bool compares_depths() const
    {
        return compares == Compares::each_tap || compares == Compares::mean_depth;
    }
    /// Whether causes follow from the hits of exact rays, without running the method again.
    [[nodiscard]] constexpr bool has_exact_causes() const
    {
        return compares != Compares::none || !has_map;
    }
    /// Whether each verdict follows from one depth that the lookup returns.
    [[nodiscard]] constexpr bool returns_deciding_depth() const
    {
        return compares == Compares::mean_depth || (is_made_of_taps() && has_one_tap());
    }
    /// Whether the verdict is known for every constant bias.
    [[nodiscard]] constexpr bool has_curve() const { return curve != Curve::none; }
    /// Whether one lookup gives the verdict for every constant bias.
    [[nodiscard]] constexpr bool has_formula() const { return curve == Curve::by_formula; }
    /// Number of equally weighted comparisons: 1 for a binary verdict; 0 if weights differ or a
    /// fraction does not come from comparisons.
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

/// The width that a kernel of this radius can read [texels]: the middle texel, and on either side
/// all texels that it reaches.
[[nodiscard]] int width_of_radius(double radius_texels);

/// The traits of verdicts blended from two maps. They lie between both, are monotone if both are,
/// and do not follow from the comparison of one lookup. The footprint is that of one map.
[[nodiscard]] LookupTraits mixed(LookupTraits promised);

/// The names of the values in results and documents: "each_tap".
[[nodiscard]] std::string_view name(Verdict verdict);
[[nodiscard]] std::string_view name(Compares compares);
[[nodiscard]] std::string_view name(Monotone rise);
[[nodiscard]] std::string_view name(Curve curve);
[[nodiscard]] std::string_view name(Reads reads);

} // namespace gnomon::methods
