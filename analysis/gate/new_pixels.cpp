#include "analysis/gate/new_pixels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace gnomon::analysis {

bool WrongPixels::knows(const PixelFilter& filter) const
{
    return !(filter.cause && cause.empty()) && !(filter.label && label.empty()) &&
           !(filter.object && object.empty()) && !(filter.bands && light_distance_m.empty());
}

bool WrongPixels::is_taken(std::size_t pixel, const PixelFilter& filter) const
{
    if (filter.object &&
        (object[pixel] >= objects.size() || objects[object[pixel]] != *filter.object)) {
        return false;
    }
    if (filter.bands && (std::isnan(light_distance_m[pixel]) ||
                         !filter.bands->has(light_distance_band_of(light_distance_m[pixel])))) {
        return false;
    }
    return (!filter.cause || cause[pixel] == *filter.cause) &&
           (!filter.label || label[pixel] == *filter.label);
}

NewPixels find_new_pixels(const PixelMask& before, const WrongPixels& now,
                          const PixelFilter& filter)
{
    if (before.size() != now.mask.size()) {
        throw std::invalid_argument("find_new_pixels: the images differ in size");
    }
    NewPixels found;
    std::array<std::uint64_t, cause_names.size()> by_cause{};
    const auto [width_px, height_px] = before.size();
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                static_cast<std::size_t>(x);
            if (now.mask[pixel] == 0 || before[pixel] != 0 || !now.is_taken(pixel, filter)) {
                continue;
            }
            found.lower = found.count == 0 ? PixelPlace{x, y}
                                           : PixelPlace{std::min(found.lower.x, x), found.lower.y};
            found.upper = {std::max(found.count == 0 ? x : found.upper.x, x), y};
            if (found.count++ < NewPixels::most_named) {
                found.first.push_back({x, y});
            }
            if (!now.cause.empty()) {
                ++by_cause[static_cast<std::size_t>(now.cause[pixel])];
            }
        }
    }
    const auto most = std::max_element(by_cause.begin() + 1, by_cause.end()); // first: "none"
    if (*most > 0) {
        found.cause = DominantCause{
            std::string{cause_names[static_cast<std::size_t>(most - by_cause.begin())]},
            static_cast<double>(*most)};
    }
    return found;
}

} // namespace gnomon::analysis
