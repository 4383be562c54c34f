#pragma once

#include "methods/list.hpp"
#include "scene/job/job.hpp"
#include "scene/light/exact_light.hpp"
#include "scene/vec.hpp"

#include <algorithm>
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

/// Which texels a lookup reads around a point of a map, exactly as the method does: all of that
/// map.
class Footprint {
public:
    Footprint(const methods::Promises& promises, scene::Outside outside, int resolution_texels)
        : kernel_{promises.kernel},
          interpolates_{promises.interpolates()},
          clamps_{outside == scene::Outside::clamp},
          width_{promises.width_texels},
          resolution_{resolution_texels}
    {
    }

    /// Calls `visit(tap)` for the taps of a lookup at the point, row by row from the lower left.
    ///
    /// Equal weights are 1 each. Those that interpolate are from fract(uv·resolution − ½) in
    /// float32, and 1 in all; with a kernel, whose means are interpolated, up to its rounding.
    template <typename Visit>
    void visit_taps(const scene::MapPoint& point, const Visit& visit) const
    {
        const scene::Texel first = first_tap(point);
        const LineWeights columns = weights(point.texel.x);
        const LineWeights rows = weights(point.texel.y);
        for (int y = 0; y < width_; ++y) {
            for (int x = 0; x < width_; ++x) {
                const double weight = interpolates_ ? columns[static_cast<std::size_t>(x)] *
                                                          rows[static_cast<std::size_t>(y)]
                                                    : 1;
                visit(tap_at(first.x + x, first.y + y, first.map, weight));
            }
        }
    }
    /// The same taps.
    [[nodiscard]] std::vector<Tap> taps(const scene::MapPoint& point) const;
    /// Appends the same taps.
    void append_taps(const scene::MapPoint& point, std::vector<Tap>& taps) const;

    /// Taps across.
    [[nodiscard]] int width_texels() const { return width_; }
    [[nodiscard]] std::size_t tap_count() const
    {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_);
    }

    /// The texel of the lower left tap, before any clamping.
    [[nodiscard]] scene::Texel first_tap(const scene::MapPoint& point) const;

    /// Index of the tap that reads the texel that contains the point, or would, were it on the map.
    [[nodiscard]] std::size_t centre_tap(const scene::MapPoint& point) const;

    /// The lower left tap's texel if all taps are on the map, which then are the square from it;
    /// else empty.
    [[nodiscard]] std::optional<scene::Texel> first_if_on_map(const scene::MapPoint& point) const;

    /// The texels of the map around the taps: the 4K + 4 around K × K; fewer at the map's border.
    [[nodiscard]] std::vector<scene::Texel> ring(const scene::MapPoint& point) const;

    /// True when the point lies on the map.
    [[nodiscard]] bool is_inside(const scene::MapPoint& point) const;

private:
    static constexpr std::size_t most_across = 10;
    static_assert(most_across * most_across == methods::most_taps);
    /// Weights along a line of taps; as many as there are taps across.
    using LineWeights = std::array<double, most_across>;

    /// Of the parts that the kernel around the two nearest texels' centres has in a point between
    /// them; without interpolation they are not read.
    [[nodiscard]] LineWeights weights(float x) const;
    [[nodiscard]] Tap tap_at(int x, int y, int map, double weight) const
    {
        if (clamps_) {
            x = std::clamp(x, 0, resolution_ - 1);
            y = std::clamp(y, 0, resolution_ - 1);
        }
        const bool is_inside = x >= 0 && y >= 0 && x < resolution_ && y < resolution_;
        return {{x, y, map}, is_inside, weight};
    }

    methods::Kernel kernel_;
    bool interpolates_;
    bool clamps_;
    int width_;
    int resolution_;
};

} // namespace gnomon::analysis
