#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// How the values that a format stores lie in [0, 1].
enum class Spacing : std::uint8_t {
    even,     ///< code/(2^bits − 1)
    floating, ///< floating-point numbers
    packed,   ///< as lessons pack them into four bytes (scene/depth/depth_codes.hpp)
};

/// How a shadow map stores depth: `d…` are GL's own depth formats, `u8`…: n-bit unorm in a depth
/// texture, written by the shader; the others are colour textures.
struct DepthFormat {
    enum class Kind : std::uint8_t { d16, d24, d32, d32f, unorm, r32f, r16f, rgba8 };
    Kind kind = Kind::d24;
    int bits = 24; ///< of a texel: 8…24 for unorm, else the format's own width

    [[nodiscard]] bool is_float() const;
    friend bool operator==(const DepthFormat&, const DepthFormat&) = default;
};

/// Who turns a fragment's depth into what is stored.
enum class Conversion : std::uint8_t {
    gl,     ///< GL, by its own rules
    shader, ///< the shader that draws the map, exactly
};

/// What holds of a kind of format.
struct DepthFormatTraits {
    DepthFormat::Kind kind;
    std::string_view name; ///< of unorm what comes before the bits
    int bits;              ///< of a texel; of unorm the most
    Spacing spacing;
    Conversion conversion;
    bool is_colour;       ///< a colour texture, which GL compares no depth with
    bool has_means;       ///< whether a mean of what two texels hold stands for a depth between
    int significant_bits; ///< of a float; else 0
    int least_exponent;   ///< of a float: its smallest step is 2 to this; else 0
};
[[nodiscard]] const DepthFormatTraits& traits_of(DepthFormat format);

/// The step from a float's value to the next one farther from 0: 2^(e − significant bits + 1) for
/// 2^e <= |value| < 2^(e+1), not below the smallest.
/// @param format  of floats
[[nodiscard]] double float_step(DepthFormat format, double value);

/// "d24", "u13", …; empty if the text names no format.
[[nodiscard]] std::optional<DepthFormat> depth_format_from_name(std::string_view name);
[[nodiscard]] std::string depth_format_name(DepthFormat format);
/// All of them: GL's depth formats, the colour formats, and the unorm ones by growing bits.
[[nodiscard]] std::vector<DepthFormat> depth_formats();
/// "d16, d24, …, u8 to u24".
[[nodiscard]] std::string depth_format_listing();

/// A map of 32-bit floats, as the other formats are judged by.
inline constexpr DepthFormat float_depth_format{DepthFormat::Kind::d32f, 32};

} // namespace gnomon::scene
