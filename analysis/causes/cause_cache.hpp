#pragma once

#include "analysis/causes/pixel_causes.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace gnomon::analysis {

/// What was found of the causes for `nearest`, kept for maps of other depth formats: with a single
/// tap nothing but whether V1 is right depends on what is stored.
///
/// Valid as long as truth, light, receivers, resolution, culling and border mode stay the same.
class CauseCache {
public:
    explicit CauseCache(scene::ImageSize size) : causes_{size}, known_{size} {}

    /// Whether the pixel's cause is remembered: that of lit pixels that V1 shadows, and of blocked
    /// ones that V1 does not shadow by other surfaces.
    [[nodiscard]] bool knows(std::size_t pixel) const { return has(pixel, knows_cause); }
    /// The cause remembered; if there is none, that of a pixel that V1 gets right.
    [[nodiscard]] const PixelCause& known(std::size_t pixel) const { return causes_[pixel]; }
    void remember(std::size_t pixel, const PixelCause& cause)
    {
        causes_[pixel] = cause;
        known_[pixel] |= knows_cause;
    }

    /// Whether the texel of a blocked pixel sees its self-shadowing surface; empty: not known.
    [[nodiscard]] std::optional<bool> own(std::size_t pixel) const
    {
        return has(pixel, knows_own) ? std::optional{has(pixel, is_own)} : std::nullopt;
    }
    void remember_own(std::size_t pixel, bool own)
    {
        known_[pixel] |= own ? knows_own | is_own : knows_own;
    }

private:
    static constexpr std::uint8_t knows_cause = 1;
    static constexpr std::uint8_t knows_own = 2;
    static constexpr std::uint8_t is_own = 4;

    [[nodiscard]] bool has(std::size_t pixel, std::uint8_t bit) const
    {
        return (known_[pixel] & bit) != 0;
    }

    scene::Image<PixelCause> causes_;
    scene::Image<std::uint8_t> known_;
};

} // namespace gnomon::analysis
