#pragma once

#include "analysis/cause.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/lookup/texel_hits.hpp"
#include "scene/exact_light.hpp"
#include "scene/job.hpp"
#include "scene/layers.hpp"

#include <limits>

namespace gnomon::analysis {

/// Everything that decides a pixel's cause, whatever the bias: one answer for all of them.
///
/// A pixel that the map without any bias (V1) gets right can only be wrong by its bias.
struct PixelCause {
    /// V3's word where V1 is wrong: `resolution` or `coverage`, and for a blocked pixel also
    /// `precision`; `none` where V1 is right.
    Cause unbiased = Cause::none;
    /// A lit pixel that V1 shadows: is the surface seen at its taps its own sheet? A blocked pixel
    /// of cause `resolution`: does a texel around its taps see the blocker?
    bool sees = false;
    /// A lit pixel that V1 shadows: the smallest bias with which exact depths are lit (V2), the
    /// slope's part included.
    float exact_critical_bias = -std::numeric_limits<float>::infinity();
};

/// The label of a scored pixel whose verdict is wrong by this cause.
[[nodiscard]] Label label_of(const PixelCause& pixel, scene::PixelClass truth, Cause cause);

/// True when a lit pixel is acne wherever it is false shadow: this does not depend on the bias.
/// Without branches: which pixels are acne is hardly to be foreseen.
[[nodiscard]] inline bool is_acne_if_shadowed(const PixelCause& pixel, scene::PixelClass truth)
{
    return (static_cast<unsigned>(truth == scene::PixelClass::lit) &
            static_cast<unsigned>(pixel.unbiased == Cause::resolution) &
            static_cast<unsigned>(pixel.sees)) != 0;
}

/// What the causes are found from.
struct CauseInputs {
    scene::LookupSettings lookup;
    int resolution_texels = 0;
    bool reversed = false;
    const scene::TruthLayers& truth;
    const scene::LookupLayers& unbiased;   ///< the lookup at the receiver itself, all biases zero
    const scene::Image<float>& map_depths; ///< as shaders see them; empty for `nearest`
    const scene::ExactLight& light;
    const TexelHits* known_hits = nullptr; ///< of the light's texels, not to be traced again

    /// Without any bias.
    [[nodiscard]] LookupRule rule() const { return {lookup.filter, lookup.outside, reversed, 0}; }
    /// The depth that GL stored in a texel that the pixel's lookup reads.
    [[nodiscard]] float stored_depth(std::size_t pixel, const scene::Texel& texel) const
    {
        // The map's rows are counted from the top, texels from the bottom.
        return scene::promises(lookup.filter).has_one_tap()
                   ? unbiased.samples[pixel].map_depth
                   : map_depths(texel.x, resolution_texels - 1 - texel.y);
    }
};

/// What `find_causes` found for `nearest`, kept for maps of other depth formats: with a single tap
/// a pixel's cause does not depend on what is stored, only whether it is wrong does.
///
/// Valid as long as truth, light, receivers, resolution, culling and policy stay the same.
class CauseMemory {
public:
    explicit CauseMemory(scene::ImageSize size) : causes_{size}, is_known_{size} {}

    [[nodiscard]] bool knows(std::size_t pixel) const { return is_known_[pixel] != 0; }
    /// What is known of the pixel; as of one that is right, if nothing is.
    [[nodiscard]] const PixelCause& known(std::size_t pixel) const { return causes_[pixel]; }
    void remember(std::size_t pixel, const PixelCause& cause)
    {
        causes_[pixel] = cause;
        is_known_[pixel] = 1;
    }

private:
    scene::Image<PixelCause> causes_;
    scene::Image<std::uint8_t> is_known_;
};

/// Finds the causes of every scored pixel that the map without bias gets wrong, for all biases.
///
/// V2 puts exact depths at the same taps, V3 is one infinitely fine lookup (DESIGN §4).
/// @param memory  Read and added to; nullptr for filters other than `nearest`.
/// @throws std::invalid_argument  if layers differ in size, map depths are missing, or a memory is
///                                given to a filter that has none.
[[nodiscard]] scene::Image<PixelCause> find_causes(const CauseInputs& inputs,
                                                   CauseMemory* memory = nullptr);

} // namespace gnomon::analysis
