#include "analysis/lookup/footprint.hpp"

#include "scene/pixels/map_texels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace gnomon::analysis {

using scene::MapPoint;
using scene::Texel;

namespace {

/// Converts a coordinate to an integer. Limits it so that it fits: farther out is just as far
/// outside.
int texel_coordinate(float x, int resolution)
{
    const auto limit = static_cast<float>(resolution + 64);
    const float limited = std::min(x > -limit ? x : -limit, limit); // handles NaN too
    const auto towards_zero = static_cast<int>(limited);
    return static_cast<float>(towards_zero) > limited ? towards_zero - 1 : towards_zero;
}

} // namespace

Texel Footprint::first_tap(const MapPoint& point) const
{
    if (is_scattered()) {
        return scattered_texel(point, 0);
    }
    const float shift = interpolates_ ? 0.5F : 0.0F;
    const int before = kernel_.width_texels() / 2 + (interpolates_ ? 0 : width_ / 2);
    return {texel_coordinate(point.texel.x - shift, resolution_) - before,
            texel_coordinate(point.texel.y - shift, resolution_) - before, point.map};
}

scene::Vec2f Footprint::scattered_place(const MapPoint& point, std::size_t i) const
{
    const scene::Vec2f& place = scattered_.places[i];
    const scene::Vec2f& axis = point.kernel_axis;
    // As in raster_gl/shaders/scattered_taps.glsl: each product and sum is rounded.
    const float x = place.x * axis.x + place.y * -axis.y;
    const float y = place.x * axis.y + place.y * axis.x;
    return {point.texel.x + x, point.texel.y + y};
}

Texel Footprint::scattered_texel(const MapPoint& point, std::size_t i) const
{
    const scene::Vec2f place = scattered_place(point, i);
    const float shift = scattered_.are_interpolated ? 0.5F : 0.0F;
    return {texel_coordinate(place.x - shift, resolution_),
            texel_coordinate(place.y - shift, resolution_), point.map};
}

std::vector<Tap> Footprint::taps(const MapPoint& point) const
{
    std::vector<Tap> taps;
    taps.reserve(tap_count());
    append_taps(point, taps);
    return taps;
}

void Footprint::append_taps(const MapPoint& point, std::vector<Tap>& taps) const
{
    visit_taps(point, [&](const Tap& tap) { taps.push_back(tap); });
}

std::array<double, 2> Footprint::shares_of_two(float x)
{
    const float shifted = x - 0.5F;
    const double upper{shifted - std::floor(shifted)};
    return {1 - upper, upper};
}

Footprint::LineWeights Footprint::weights(float x) const
{
    LineWeights line{};
    if (!interpolates_) {
        return line;
    }
    const auto [lower, upper] = shares_of_two(x);
    if (kernel_.weights.empty()) {
        line[0] = lower;
        line[1] = upper;
        return line;
    }
    for (std::size_t i = 0; i < kernel_.weights.size(); ++i) {
        const double weight{kernel_.weights[i]};
        line[i] += weight * lower;
        line[i + 1] += weight * upper;
    }
    return line;
}

double Footprint::missing_weight(const Texel& first, const LineWeights& columns,
                                 const LineWeights& rows) const
{
    if (edge_ != MapEdge::seam || width_ != 2) {
        return 0;
    }
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) {
            if (is_missing(first.x + x, first.y + y)) {
                return columns[static_cast<std::size_t>(x)] * rows[static_cast<std::size_t>(y)];
            }
        }
    }
    return 0;
}

Texel Footprint::texel_beyond(const Texel& texel) const
{
    if (edge_ == MapEdge::seam) {
        return scene::texel_across_seams(texel, resolution_);
    }
    return {std::clamp(texel.x, 0, resolution_ - 1), std::clamp(texel.y, 0, resolution_ - 1),
            texel.map};
}

std::size_t Footprint::centre_tap(const MapPoint& point) const
{
    if (is_scattered()) {
        return centre_of_scattered(point);
    }
    const Texel first = first_tap(point);
    const auto place = [&](float x, int lowest) {
        return static_cast<std::size_t>(
            std::clamp(texel_coordinate(x, resolution_) - lowest, 0, width_ - 1));
    };
    return place(point.texel.y, first.y) * static_cast<std::size_t>(width_) +
           place(point.texel.x, first.x);
}

std::size_t Footprint::centre_of_scattered(const MapPoint& point) const
{
    if (!scattered_.are_interpolated) {
        return 0;
    }
    const int across = 2;
    const Texel middle{texel_coordinate(point.texel.x, resolution_),
                       texel_coordinate(point.texel.y, resolution_), point.map};
    std::size_t nearest = 0;
    int least = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < scattered_.places.size(); ++i) {
        const Texel first = scattered_texel(point, i);
        for (int of_four = 0; of_four < across * across; ++of_four) {
            const int x = first.x + of_four % across - middle.x;
            const int y = first.y + of_four / across - middle.y;
            if (x * x + y * y < least) {
                least = x * x + y * y;
                nearest = i * 4 + static_cast<std::size_t>(of_four);
            }
        }
    }
    return nearest;
}

std::optional<Texel> Footprint::first_if_on_map(const MapPoint& point) const
{
    if (is_scattered()) {
        return std::nullopt;
    }
    const Texel first = first_tap(point);
    const Texel last{first.x + width_ - 1, first.y + width_ - 1, first.map};
    return is_on_map(first) && is_on_map(last) ? std::optional{first} : std::nullopt;
}

void Footprint::append_texel(const Texel& texel, std::vector<Texel>& texels) const
{
    if (is_on_map(texel)) {
        texels.push_back(texel);
    } else if (edge_ == MapEdge::seam) {
        texels.push_back(texel_beyond(texel));
    }
}

std::vector<Texel> Footprint::ring_of_scattered(const MapPoint& point) const
{
    const auto place = [](const Texel& texel) { return std::pair{texel.y, texel.x}; };
    std::set<std::pair<int, int>> taps;
    std::set<std::pair<int, int>> around;
    const int across = scattered_.are_interpolated ? 2 : 1;
    for (std::size_t i = 0; i < scattered_.places.size(); ++i) {
        const Texel first = scattered_texel(point, i);
        for (int y = -1; y <= across; ++y) {
            for (int x = -1; x <= across; ++x) {
                const bool is_tap = x >= 0 && y >= 0 && x < across && y < across;
                (is_tap ? taps : around).insert(place({first.x + x, first.y + y, first.map}));
            }
        }
    }
    std::vector<Texel> texels;
    for (const auto& [y, x] : around) {
        if (!taps.contains({y, x})) {
            append_texel({x, y, point.map}, texels);
        }
    }
    return texels;
}

std::vector<Texel> Footprint::ring(const MapPoint& point) const
{
    if (is_scattered()) {
        return ring_of_scattered(point);
    }
    const Texel first = first_tap(point);
    std::vector<Texel> texels;
    for (int y = -1; y <= width_; ++y) {
        for (int x = -1; x <= width_; ++x) {
            const bool is_tap = x >= 0 && y >= 0 && x < width_ && y < width_;
            const Texel texel{first.x + x, first.y + y, first.map};
            if (!is_tap) {
                append_texel(texel, texels);
            }
        }
    }
    return texels;
}

bool Footprint::is_inside(const MapPoint& point) const
{
    const auto resolution = static_cast<float>(resolution_);
    return edge_ == MapEdge::seam || (point.texel.x >= 0 && point.texel.y >= 0 &&
                                      point.texel.x < resolution && point.texel.y < resolution);
}

} // namespace gnomon::analysis
