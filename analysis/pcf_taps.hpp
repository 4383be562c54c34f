#pragma once

#include "analysis/critical_bias.hpp"
#include "scene/image.hpp"
#include "scene/layers.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <span>

namespace gnomon::analysis {

/// The stored depths that a pcfK lookup reads, gathered as raster_gl/shaders/lookup.frag does.
class PcfTaps {
public:
    /// @param map_depths  As shaders see them, top left first, square; must outlive this.
    PcfTaps(const scene::Image<float>& map_depths, const LookupRule& rule);

    /// Writes the K × K depths to `out`; a tap outside the map is infinitely far or near, so that
    /// its verdict is the policy's whatever the bias.
    /// @param texel  uv · resolution of the lookup.
    /// @param out    At least K² long.
    /// @return  What was written; empty where the policy decides for all taps: beyond far, or
    ///          behind a spot.
    [[nodiscard]] std::span<float> gather(const scene::LookupSample& sample, scene::Vec2f texel,
                                          std::span<float> out) const;

private:
    [[nodiscard]] bool policy_decides_all(const scene::LookupSample& sample,
                                          scene::Vec2f centre) const;
    [[nodiscard]] bool is_inside(scene::Vec2f texel) const;
    [[nodiscard]] float depth_at(scene::Vec2f texel) const;
    float* write(scene::Vec2f centre, float* out) const;

    const scene::Image<float>& map_;
    bool clamps_;
    bool reversed_;
    int radius_;
    float last_;    ///< texel of the map's last column and row
    float outside_; ///< depth of a tap outside
};

} // namespace gnomon::analysis
