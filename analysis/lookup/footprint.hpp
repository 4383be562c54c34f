#pragma once

#include "methods/list.hpp"
#include "renderers/light_queries.hpp"
#include "scene/settings/job.hpp"
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
    double weight = 1;     ///< exact: sums of a lookup's weights do not round; what counts is its
                           ///< share of them
};

/// What a tap beyond a map's sides reads.
enum class MapEdge : std::uint8_t {
    border, ///< no texel: the border mode decides
    clamp,  ///< the nearest texel on the map
    seam,   ///< the neighbouring map's (`scene::texel_across_seams`)
};
/// @param has_seams  The light's maps are the faces of a cube.
[[nodiscard]] constexpr MapEdge map_edge(scene::Outside outside, bool has_seams)
{
    if (has_seams) {
        return MapEdge::seam;
    }
    return outside == scene::Outside::clamp ? MapEdge::clamp : MapEdge::border;
}

/// Some of a lookup's taps, in the order of its footprint.
using TapSet = std::bitset<methods::most_taps>;

/// Which texels a lookup reads around a point of a map, exactly as the method does: of that map, or
/// beyond its seams of its neighbours.
class Footprint {
public:
    Footprint(const methods::LookupTraits& traits, MapEdge edge, int resolution_texels)
        : kernel_{traits.kernel},
          scattered_{traits.taps},
          interpolates_{traits.interpolates()},
          edge_{edge},
          width_{traits.width_texels},
          resolution_{resolution_texels}
    {
    }

    /// Calls `visit(tap)` for the taps of a lookup at the point, row by row from the lower left, or
    /// in their own order where they are scattered.
    ///
    /// Equal weights are 1 each. Those that interpolate are from fract(uv·resolution − ½) in
    /// float32, and 1 in all; with a kernel, whose means are interpolated, the square of its sum.
    /// At a cube's corner, where three texels meet, a fourth that would interpolate has weight 0,
    /// and the three share what it had, as GL recommends.
    template <typename Visit>
    void visit_taps(const scene::MapPoint& point, const Visit& visit) const
    {
        if (is_scattered()) {
            visit_scattered(point, visit);
            return;
        }
        const scene::Texel first = first_tap(point);
        const LineWeights columns = weights(point.texel.x);
        const LineWeights rows = weights(point.texel.y);
        const double missing = interpolates_ ? missing_weight(first, columns, rows) : 0;
        for (int y = 0; y < width_; ++y) {
            for (int x = 0; x < width_; ++x) {
                double weight = interpolates_ ? columns[static_cast<std::size_t>(x)] *
                                                    rows[static_cast<std::size_t>(y)]
                                              : 1;
                if (missing > 0) {
                    weight = is_missing(first.x + x, first.y + y) ? 0 : weight + missing / 3;
                }
                visit(tap_at({first.x + x, first.y + y, first.map}, weight));
            }
        }
    }
    /// The same taps.
    [[nodiscard]] std::vector<Tap> taps(const scene::MapPoint& point) const;
    /// Appends the same taps.
    void append_taps(const scene::MapPoint& point, std::vector<Tap>& taps) const;

    /// Taps across, where they are a square.
    [[nodiscard]] int width_texels() const { return width_; }
    [[nodiscard]] std::size_t tap_count() const
    {
        return is_scattered() ? scattered_.texel_count()
                              : static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_);
    }

    /// The texel of the lower left tap, or of the first one where they are scattered, before any
    /// clamping.
    [[nodiscard]] scene::Texel first_tap(const scene::MapPoint& point) const;

    /// Index of the tap that reads the texel that contains the point, or would, were it on the map;
    /// of scattered ones that read others, of the nearest.
    [[nodiscard]] std::size_t centre_tap(const scene::MapPoint& point) const;

    /// The lower left tap's texel if all taps are on the map, which then are the square from it;
    /// else, and where taps are scattered, empty.
    [[nodiscard]] std::optional<scene::Texel> first_if_on_map(const scene::MapPoint& point) const;

    /// The texels around the taps: the 4K + 4 around K × K, or of scattered ones those next to each
    /// that are none themselves; fewer at a map's border.
    [[nodiscard]] std::vector<scene::Texel> ring(const scene::MapPoint& point) const;

    /// True when the point lies on the map; a cube's faces leave nothing out.
    [[nodiscard]] bool is_inside(const scene::MapPoint& point) const;

private:
    static constexpr std::size_t most_across = 10;
    static_assert(most_across * most_across == methods::most_taps);
    /// Weights along a line of taps; as many as there are taps across.
    using LineWeights = std::array<double, most_across>;

    [[nodiscard]] bool is_scattered() const { return !scattered_.places.empty(); }
    /// Where the i-th scattered tap lies [texels].
    [[nodiscard]] scene::Vec2f scattered_place(const scene::MapPoint& point, std::size_t i) const;
    /// The texel that it reads, or the lower left one of its four, before any clamping.
    [[nodiscard]] scene::Texel scattered_texel(const scene::MapPoint& point, std::size_t i) const;
    /// The same, as `visit_taps` does.
    template <typename Visit>
    void visit_scattered(const scene::MapPoint& point, const Visit& visit) const
    {
        for (std::size_t i = 0; i < scattered_.places.size(); ++i) {
            const double weight = scattered_.weights.empty() ? 1 : double{scattered_.weights[i]};
            const scene::Texel first = scattered_texel(point, i);
            if (!scattered_.are_interpolated) {
                visit(tap_at(first, weight));
                continue;
            }
            const scene::Vec2f place = scattered_place(point, i);
            const std::array<double, 2> columns = shares_of_two(place.x);
            const std::array<double, 2> rows = shares_of_two(place.y);
            for (int y = 0; y < 2; ++y) {
                for (int x = 0; x < 2; ++x) {
                    visit(tap_at({first.x + x, first.y + y, first.map},
                                 weight * columns.at(static_cast<std::size_t>(x)) *
                                     rows.at(static_cast<std::size_t>(y))));
                }
            }
        }
    }
    [[nodiscard]] std::size_t centre_of_scattered(const scene::MapPoint& point) const;
    [[nodiscard]] std::vector<scene::Texel> ring_of_scattered(const scene::MapPoint& point) const;

    /// Appends what is read there, if anything is.
    void append_texel(const scene::Texel& texel, std::vector<scene::Texel>& texels) const;
    /// Of the two texels whose centres are nearest, along a line of them: fract(x − ½) in float32.
    [[nodiscard]] static std::array<double, 2> shares_of_two(float x);
    /// Of the parts that the kernel around the two nearest texels' centres has in a point between
    /// them; without interpolation they are not read.
    [[nodiscard]] LineWeights weights(float x) const;
    /// Weight of the tap of a 2 × 2 footprint that a cube's corner has no texel for; else 0.
    [[nodiscard]] double missing_weight(const scene::Texel& first, const LineWeights& columns,
                                        const LineWeights& rows) const;
    /// Whether there is no texel: beyond two sides of a cube's face.
    [[nodiscard]] bool is_missing(int x, int y) const
    {
        return (x < 0 || x >= resolution_) && (y < 0 || y >= resolution_);
    }
    [[nodiscard]] bool is_on_map(const scene::Texel& texel) const
    {
        return texel.x >= 0 && texel.y >= 0 && texel.x < resolution_ && texel.y < resolution_;
    }
    /// @param texel  before any clamping.
    [[nodiscard]] Tap tap_at(scene::Texel texel, double weight) const
    {
        if (is_on_map(texel)) {
            return {texel, true, weight};
        }
        return edge_ == MapEdge::border ? Tap{texel, false, weight}
                                        : Tap{texel_beyond(texel), true, weight};
    }
    /// What is read in place of a texel beyond the map's sides.
    [[nodiscard]] scene::Texel texel_beyond(const scene::Texel& texel) const;

    methods::Kernel kernel_;
    methods::ScatteredTaps scattered_;
    bool interpolates_;
    MapEdge edge_;
    int width_;
    int resolution_;
};

} // namespace gnomon::analysis
