#pragma once

#include "analysis/metrics/metrics.hpp"
#include "scene/image.hpp"

#include <cstdint>
#include <string>

namespace gnomon::cli {

/// The mask that a renderer drew last, to notice when it comes again for another scene.
class LastMask {
public:
    /// Takes the next mask.
    /// @param opened  the mesh, camera, light and image that it was drawn of, as text.
    /// @return  Whether it is bit by bit the one before, drawn of something else.
    [[nodiscard]] bool take(const scene::Image<float>& mask, const std::string& opened);

    /// Takes what was measured of it.
    /// @return  Whether it cannot be the one before: the exact shadow has more or fewer pixels, by
    ///          over 1 % of those that are scored. Not said of a mask that lights all of them, or
    ///          none: any number of scenes share it.
    [[nodiscard]] bool must_differ(const analysis::Metrics& measured);

private:
    scene::Image<float> mask_;
    std::string opened_;
    std::uint64_t blocked_ = 0;
};

} // namespace gnomon::cli
