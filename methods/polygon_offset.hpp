#pragma once

namespace gnomon::methods {

/// What GL adds to the window depth of what it draws into a map:
///
///     o = factor · m + units · r     clamp > 0: at most clamp,  clamp < 0: at least clamp
///
/// m the larger of the depth's changes per texel along u and v, or up to √2 times that, and r the
/// smallest difference that surely changes what is stored: both are the driver's.
/// Source: OpenGL 4.6, 14.6.5.
struct PolygonOffset {
    float factor = 0;
    float units = 0;
    float clamp = 0; ///< window depth; 0: none

    friend bool operator==(const PolygonOffset&, const PolygonOffset&) = default;
};

} // namespace gnomon::methods
