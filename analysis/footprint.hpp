#pragma once

#include "scene/exact_light.hpp"
#include "scene/job.hpp"
#include "scene/vec.hpp"

#include <vector>

namespace gnomon::analysis {

/// One tap of a lookup: which texel it reads, and how much it counts.
struct Tap {
    scene::Texel texel;
    bool is_inside = true; ///< else there is no texel: the policy decides
    double weight = 1;     ///< exact: sums of a lookup's weights do not round
};

/// Which texels a filter reads around a point of the map, exactly as the lookup does.
class Footprint {
public:
    Footprint(const scene::LookupSettings& settings, int resolution_texels)
        : interpolates_{scene::promises(settings.filter).interpolates()},
          clamps_{settings.outside == scene::Outside::clamp},
          width_{scene::filter_width_texels(settings.filter)},
          resolution_{resolution_texels}
    {
    }

    /// The taps of a lookup at `uv·resolution`, row by row from the lower left.
    ///
    /// nearest and pcf: 1 each. linear and hardware: from fract(uv·resolution − ½) in float32, 1 in
    /// all.
    [[nodiscard]] std::vector<Tap> taps(const scene::Vec2f& point) const;
    /// Appends the same taps.
    void append_taps(const scene::Vec2f& point, std::vector<Tap>& taps) const;

    [[nodiscard]] std::size_t tap_count() const
    {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_);
    }

    /// The texels of the map around the taps: nearest, the 8 around one; linear and hardware, the
    /// 12 around 2×2; pcfK, the 4K + 4 around K×K.
    [[nodiscard]] std::vector<scene::Texel> ring(const scene::Vec2f& point) const;

    /// True when the point lies on the map.
    [[nodiscard]] bool is_inside(const scene::Vec2f& point) const;

private:
    /// The lower left tap, before any clamping.
    [[nodiscard]] scene::Texel first_tap(const scene::Vec2f& point) const;

    bool interpolates_;
    bool clamps_;
    int width_;
    int resolution_;
};

} // namespace gnomon::analysis
