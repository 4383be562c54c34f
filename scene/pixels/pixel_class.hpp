#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace gnomon::scene {

/// A pixel's class; the values are the EXR codes. If several apply, the first counts: background,
/// unmatched, attached, out_of_light, blocked, indeterminate, lit.
enum class PixelClass : std::uint8_t {
    background = 0,    ///< neither GL nor the exact ray sees a surface
    unmatched = 1,     ///< only one of them sees one, or they see different triangles
    attached = 2,      ///< the light is behind the visible side, or in its plane
    out_of_light = 3,  ///< outside a spot's cone
    indeterminate = 4, ///< the segment to the light touches an edge or a vertex, or lies in a plane
    lit = 5,           ///< nothing touches the segment to the light
    blocked = 6,       ///< a triangle, or a seam of two, crosses the segment to the light
};
inline constexpr std::size_t pixel_class_count = 7;
inline constexpr std::array<std::string_view, pixel_class_count> pixel_class_names{
    "background", "unmatched", "attached", "out_of_light", "indeterminate", "lit", "blocked"};

/// Why a pixel is `unmatched` or `indeterminate`; `none` for every other class.
enum class ClassReason : std::uint8_t {
    none = 0,
    snap = 1,       ///< unmatched: coverage of the pixel centre differs after GL's snapping
    tie = 2,        ///< unmatched: both cover it, closer together than the depth buffer resolves
    mismatch = 3,   ///< unmatched: neither explains it, a defect
    silhouette = 4, ///< indeterminate: the segment touches an edge without passing through
    vertex = 5,     ///< indeterminate: the segment touches a vertex
    graze = 6,      ///< indeterminate: the segment runs inside a triangle's plane
    rounding = 7,   ///< indeterminate: points that round to P differ, or are not shown to agree
};

inline constexpr std::size_t class_reason_count = 8;

/// Whether the class is lit or blocked. Unscored pixels are neither.
[[nodiscard]] constexpr bool is_lit(PixelClass pixel_class)
{
    return pixel_class == PixelClass::lit;
}
[[nodiscard]] constexpr bool is_blocked(PixelClass pixel_class)
{
    return pixel_class == PixelClass::blocked;
}

/// Whether the class enters rates: `lit` and `blocked`.
[[nodiscard]] constexpr bool is_scored(PixelClass pixel_class)
{
    return is_lit(pixel_class) || is_blocked(pixel_class);
}

} // namespace gnomon::scene
