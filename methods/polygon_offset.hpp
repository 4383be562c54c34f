#pragma once

namespace gnomon::methods {

/// GL's polygon offset, added to the window depth of casters in a map:
///
///     o = factor · m + units · r     clamp > 0: at most clamp,  clamp < 0: at least clamp
///
/// m is the larger of the depth's changes per texel along u and v, or up to √2 times that; r is the
/// smallest difference that is sure to change the stored depth. Both depend on the driver.
/// Source: OpenGL 4.6, 14.6.5.
struct PolygonOffset {
    float factor = 0;
    float units = 0;
    float clamp = 0; ///< window depth; 0: none

    friend bool operator==(const PolygonOffset&, const PolygonOffset&) = default;
};

} // namespace gnomon::methods
