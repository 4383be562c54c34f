#pragma once

#include <cstdint>
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
    none,       ///< no comparison of depths
};

/// Whether a verdict can only rise when the constant bias does.
enum class Rise : std::uint8_t {
    exactly,        ///< it never falls
    up_to_rounding, ///< it falls by rounding errors alone
    no,
};

/// A promise about rising, with its size where it has one.
struct Rises {
    Rise how = Rise::exactly;
    double largest_fall = 0; ///< of a verdict [0, 1]; 0 unless `how` is `up_to_rounding`

    friend bool operator==(const Rises&, const Rises&) = default;
};

/// How the critical bias of a pixel is found.
enum class Curve : std::uint8_t {
    by_formula,   ///< from one lookup, for every constant bias
    by_bisection, ///< GL itself, asked with biases of its own at each pixel
    none,         ///< not at all: GL looks up again for each bias that is asked for
};

/// What a method promises of the lookups of a job. Ask this, not which method or filter it is.
struct Promises {
    Verdict verdict = Verdict::binary;
    Compares compares = Compares::each_tap;
    Rises rises;
    Curve curve = Curve::by_formula;
    bool has_map = true; ///< else nothing is drawn from the light

    friend bool operator==(const Promises&, const Promises&) = default;
};

/// Each value as results and documents spell it: "each_tap".
[[nodiscard]] std::string_view name(Verdict verdict);
[[nodiscard]] std::string_view name(Compares compares);
[[nodiscard]] std::string_view name(Rise rise);
[[nodiscard]] std::string_view name(Curve curve);

} // namespace gnomon::methods
