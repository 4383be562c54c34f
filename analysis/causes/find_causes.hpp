#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace gnomon::analysis {

/// Remembers the causes for `nearest`, for reuse with other depth formats. With a single tap,
/// stored depths matter only to whether V1 is right.
///
/// Valid while truth, light, receivers, resolution, culling and border mode stay the same.
class CauseCache {
public:
    explicit CauseCache(scene::ImageSize size) : causes_{size}, known_{size} {}

    /// Whether the pixel's cause is known: of lit pixels that V1 shadows, and of blocked pixels
    /// unless V1 shadows them by other surfaces.
    [[nodiscard]] bool knows(std::size_t pixel) const { return has(pixel, knows_cause); }
    /// The known cause; if unknown, that of a pixel that V1 gets right.
    [[nodiscard]] const PixelCause& known(std::size_t pixel) const { return causes_[pixel]; }
    void remember(std::size_t pixel, const PixelCause& cause)
    {
        causes_[pixel] = cause;
        known_[pixel] |= knows_cause;
    }

    /// Whether the texel of a blocked pixel sees its self-shadowing surface; empty if unknown.
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

/// Finds why scored lit pixels are wrong or partial, at every bias.
/// @param causes  Of the image's size; set at the lit pixels. Its `filters` may be empty for
///                `nearest`.
/// @param cache   Read and extended; null for filters other than `nearest`.
/// @throws std::invalid_argument  as `require_cause_inputs`.
void find_lit_causes(const CauseInputs& inputs, PixelCauses& causes, CauseCache* cache = nullptr);

/// Finds why scored blocked pixels are wrong or partial, at every bias. Self-shadowing never counts
/// as a repair (docs/causes.md).
/// @param wanted  1 at the pixels to explain, which are all blocked.
/// @param causes  Of the image's size; set at those pixels.
/// @param cache   Read and extended; null for filters other than `nearest`.
/// @throws std::invalid_argument  as `require_cause_inputs`.
void find_blocked_causes(const CauseInputs& inputs, const scene::Image<std::uint8_t>& wanted,
                         PixelCauses& causes, CauseCache* cache = nullptr);

} // namespace gnomon::analysis
