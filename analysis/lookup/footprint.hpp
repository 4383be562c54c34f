#pragma once

#include "methods/depth/filters.hpp"
#include "scene/job/job.hpp"
#include "scene/light/exact_light.hpp"
#include "scene/vec.hpp"

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// One tap of a lookup: which texel it reads, and how much it counts.
struct Tap {
    scene::Texel texel;
    bool is_inside = true; ///< else there is no texel: the border mode decides
    double weight = 1;     ///< exact: sums of a lookup's weights do not round
};

/// Some of a lookup's taps, in the order of its footprint.
using TapSet = std::bitset<methods::most_taps>;

/// Which texels a filter reads around a point of the map, exactly as the lookup does.
class Footprint {
public:
    Footprint(const scene::LookupSettings& settings, int resolution_texels)
        : interpolates_{methods::filter_promises(settings.filter).interpolates()},
          clamps_{settings.outside == scene::Outside::clamp},
          width_{methods::filter_promises(settings.filter).width_texels},
          resolution_{resolution_texels}
    {
    }

    /// Calls `visit(tap)` for the taps of a lookup at `uv·resolution`, row by row from the lower
    /// left.
    ///
    /// nearest and pcf: of weight 1 each. linear and hardware: from fract(uv·resolution − ½) in
    /// float32, 1 in all.
    template <typename Visit>
    void visit_taps(const scene::Vec2f& point, const Visit& visit) const
    {
        const scene::Texel first = first_tap(point);
        const std::array<double, 2> columns = weights(point.x);
        const std::array<double, 2> rows = weights(point.y);
        for (int y = 0; y < width_; ++y) {
            for (int x = 0; x < width_; ++x) {
                const double weight = interpolates_ ? columns[static_cast<std::size_t>(x)] *
                                                          rows[static_cast<std::size_t>(y)]
                                                    : 1;
                visit(tap_at({first.x + x, first.y + y}, weight));
            }
        }
    }
    /// The same taps.
    [[nodiscard]] std::vector<Tap> taps(const scene::Vec2f& point) const;
    /// Appends the same taps.
    void append_taps(const scene::Vec2f& point, std::vector<Tap>& taps) const;

    /// Taps across.
    [[nodiscard]] int width_texels() const { return width_; }
    [[nodiscard]] std::size_t tap_count() const
    {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_);
    }

    /// The texel of the lower left tap, before any clamping.
    [[nodiscard]] scene::Texel first_tap(const scene::Vec2f& point) const;

    /// Index of the tap that reads the texel that contains the point, or would, were it on the map.
    [[nodiscard]] std::size_t centre_tap(const scene::Vec2f& point) const;

    /// The lower left tap's texel if all taps are on the map, which then are the square from it;
    /// else empty.
    [[nodiscard]] std::optional<scene::Texel> first_if_on_map(const scene::Vec2f& point) const;

    /// The texels of the map around the taps: nearest, the 8 around one; linear and hardware, the
    /// 12 around 2×2; pcfK, the 4K + 4 around K×K; fewer at the map's border.
    [[nodiscard]] std::vector<scene::Texel> ring(const scene::Vec2f& point) const;

    /// True when the point lies on the map.
    [[nodiscard]] bool is_inside(const scene::Vec2f& point) const;

private:
    /// The parts of two neighbours' centres in a point between them, the lower one's first.
    [[nodiscard]] static std::array<double, 2> weights(float x);
    [[nodiscard]] Tap tap_at(scene::Texel texel, double weight) const;

    bool interpolates_;
    bool clamps_;
    int width_;
    int resolution_;
};

} // namespace gnomon::analysis
