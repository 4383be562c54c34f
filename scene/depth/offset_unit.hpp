#pragma once

namespace gnomon::scene {

/// The unit r of glPolygonOffset at a depth: `units` of 1 add r to the window depth.
struct OffsetUnit {
    double depth = 0; ///< of the plane, without offset
    double r = 0;     ///< window depth
};

} // namespace gnomon::scene
