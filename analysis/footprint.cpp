#include "analysis/footprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::analysis {

using scene::Texel;
using scene::Vec2f;

namespace {

/// A texel's coordinate, kept where it can be counted: what is farther off is as far outside.
int texel_coordinate(float x, int resolution)
{
    const auto limit = static_cast<float>(resolution + 64);
    const float at_least = x > -limit ? std::floor(x) : -limit; // NaN included
    return static_cast<int>(std::min(at_least, limit));
}

bool is_on_map(const Texel& texel, int resolution)
{
    return texel.x >= 0 && texel.y >= 0 && texel.x < resolution && texel.y < resolution;
}

/// The part of a whole that goes to the upper of two neighbours.
double upper_weight(float x)
{
    const float shifted = x - 0.5F;
    return double{shifted - std::floor(shifted)};
}

} // namespace

Texel Footprint::first_tap(const Vec2f& point) const
{
    if (interpolates_) {
        return {texel_coordinate(point.x - 0.5F, resolution_),
                texel_coordinate(point.y - 0.5F, resolution_)};
    }
    return {texel_coordinate(point.x, resolution_) - width_ / 2,
            texel_coordinate(point.y, resolution_) - width_ / 2};
}

std::vector<Tap> Footprint::taps(const Vec2f& point) const
{
    std::vector<Tap> taps;
    taps.reserve(tap_count());
    append_taps(point, taps);
    return taps;
}

void Footprint::append_taps(const Vec2f& point, std::vector<Tap>& taps) const
{
    const Texel first = first_tap(point);
    const bool is_weighted = interpolates_;
    const double right = is_weighted ? upper_weight(point.x) : 0;
    const double above = is_weighted ? upper_weight(point.y) : 0;
    const std::array<double, 4> bilinear{(1 - right) * (1 - above), right * (1 - above),
                                         (1 - right) * above, right * above};
    std::size_t next = 0;
    for (int y = 0; y < width_; ++y) {
        for (int x = 0; x < width_; ++x) {
            Tap tap{{first.x + x, first.y + y}, true, 1};
            if (clamps_) {
                tap.texel = {std::clamp(tap.texel.x, 0, resolution_ - 1),
                             std::clamp(tap.texel.y, 0, resolution_ - 1)};
            }
            tap.is_inside = is_on_map(tap.texel, resolution_);
            if (is_weighted) {
                tap.weight = bilinear[next++];
            }
            taps.push_back(tap);
        }
    }
}

std::vector<Texel> Footprint::ring(const Vec2f& point) const
{
    const Texel first = first_tap(point);
    std::vector<Texel> texels;
    for (int y = -1; y <= width_; ++y) {
        for (int x = -1; x <= width_; ++x) {
            const bool is_tap = x >= 0 && y >= 0 && x < width_ && y < width_;
            const Texel texel{first.x + x, first.y + y};
            if (!is_tap && is_on_map(texel, resolution_)) {
                texels.push_back(texel);
            }
        }
    }
    return texels;
}

bool Footprint::is_inside(const Vec2f& point) const
{
    const auto resolution = static_cast<float>(resolution_);
    return point.x >= 0 && point.y >= 0 && point.x < resolution && point.y < resolution;
}

} // namespace gnomon::analysis
