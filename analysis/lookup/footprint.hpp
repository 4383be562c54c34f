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

/// One tap of a lookup: the texel it reads and its weight.
struct Tap {
    scene::Texel texel;
    bool is_inside = true; ///< false: there is no texel, and the border mode decides
    double weight = 1;     ///< relative to the others; exact, so that sums of weights do not round
};

/// Where a tap beyond a map's sides reads.
enum class MapEdge : std::uint8_t {
    border, ///< nowhere: the border mode decides
    clamp,  ///< the nearest texel on the map
    seam,   ///< the neighbouring map (`scene::texel_across_seams`)
};
/// @param has_seams  The light's maps are the faces of a cube.
[[nodiscard]] constexpr MapEdge map_edge(scene::Outside outside, bool has_seams)
{
    if (has_seams) {
        return MapEdge::seam;
    }
    return outside == scene::Outside::clamp ? MapEdge::clamp : MapEdge::border;
}

/// A subset of a lookup's taps, in the order of its footprint.
using TapSet = std::bitset<methods::most_taps>;

/// The texels that a lookup reads around a point of a map, exactly as the method does. Beyond a
/// seam, they belong to the neighbouring map.
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

    /// Calls `visit(tap)` for each tap of a lookup at the point: row by row from the lower left, or
    /// in their own order if they are scattered.
    ///
    /// Equal weights are 1 each. Interpolating weights come from fract(uv·resolution − ½) in
    /// float32 and add up to 1; with a kernel, whose means are interpolated, to the square of its
    /// sum. At a cube's corner, where three texels meet, the missing fourth has weight 0, and the
    /// three share its weight, as GL recommends.
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
    /// The taps that `visit_taps` visits.
    [[nodiscard]] std::vector<Tap> taps(const scene::MapPoint& point) const;
    /// Appends the taps that `visit_taps` visits.
    void append_taps(const scene::MapPoint& point, std::vector<Tap>& taps) const;

    /// Taps across, if they form a square.
    [[nodiscard]] int width_texels() const { return width_; }
    [[nodiscard]] std::size_t tap_count() const
    {
        return is_scattered() ? scattered_.texel_count()
                              : static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_);
    }

    /// The texel of the lower left tap, or of the first scattered one, before any clamping.
    [[nodiscard]] scene::Texel first_tap(const scene::MapPoint& point) const;

    /// Index of the tap that reads the texel containing the point, even if that texel is off the
    /// map. If no scattered tap reads it, the nearest tap.
    [[nodiscard]] std::size_t centre_tap(const scene::MapPoint& point) const;

    /// The lower left tap's texel if the taps form a square that lies wholly on the map; else
    /// empty.
    [[nodiscard]] std::optional<scene::Texel> first_if_on_map(const scene::MapPoint& point) const;

    /// The texels around the taps: the 4K + 4 around K × K, or those next to scattered taps. Fewer
    /// at a map's border.
    [[nodiscard]] std::vector<scene::Texel> ring(const scene::MapPoint& point) const;

    /// Whether the point lies on the map. A cube's faces cover every direction.
    [[nodiscard]] bool is_inside(const scene::MapPoint& point) const;

private:
    static constexpr std::size_t most_across = 10;
    static_assert(most_across * most_across == methods::most_taps);
    /// Weights along a line of taps, one for each tap across.
    using LineWeights = std::array<double, most_across>;

    [[nodiscard]] bool is_scattered() const { return !scattered_.places.empty(); }
    /// Position of the i-th scattered tap [texels].
    [[nodiscard]] scene::Vec2f scattered_place(const scene::MapPoint& point, std::size_t i) const;
    /// The texel that it reads, or the lower left of its four, before any clamping.
    [[nodiscard]] scene::Texel scattered_texel(const scene::MapPoint& point, std::size_t i) const;
    /// `visit_taps` for scattered taps.
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

    /// Appends the texel that is read in this place, if any.
    void append_texel(const scene::Texel& texel, std::vector<scene::Texel>& texels) const;
    /// Weights of the two texels nearest along a line: from fract(x − ½) in float32.
    [[nodiscard]] static std::array<double, 2> shares_of_two(float x);
    /// Weights along a line that result from interpolating the kernel's means between the two
    /// nearest texels. Unused without interpolation.
    [[nodiscard]] LineWeights weights(float x) const;
    /// Weight of the tap of a 2 × 2 footprint for which a cube's corner has no texel; else 0.
    [[nodiscard]] double missing_weight(const scene::Texel& first, const LineWeights& columns,
                                        const LineWeights& rows) const;
    /// Whether the texel lies beyond two sides of a cube's face, where none exists.
    [[nodiscard]] bool is_missing(int x, int y) const
    {
        return (x < 0 || x >= resolution_) && (y < 0 || y >= resolution_);
    }
    [[nodiscard]] bool is_on_map(const scene::Texel& texel) const
    {
        return texel.x >= 0 && texel.y >= 0 && texel.x < resolution_ && texel.y < resolution_;
    }
    /// @param texel  Before any clamping.
    [[nodiscard]] Tap tap_at(scene::Texel texel, double weight) const
    {
        if (is_on_map(texel)) {
            return {texel, true, weight};
        }
        return edge_ == MapEdge::border ? Tap{texel, false, weight}
                                        : Tap{texel_beyond(texel), true, weight};
    }
    /// The texel that is read in place of one beyond the map's sides.
    [[nodiscard]] scene::Texel texel_beyond(const scene::Texel& texel) const;

    methods::Kernel kernel_;
    methods::ScatteredTaps scattered_;
    bool interpolates_;
    MapEdge edge_;
    int width_;
    int resolution_;
};

} // namespace gnomon::analysis
