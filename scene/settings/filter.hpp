#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon::scene {

/// How a lookup filters the map, as a job names it; the layer `methods` describes each.
enum class Filter : std::uint8_t {
    nearest,
    linear,
    hardware,
    pcf3,
    pcf5,
    pcf7,
    pcf9,
    bilinear3,
    bilinear5,
    bilinear7
};

/// The filter's name in job files; empty for an invalid value.
[[nodiscard]] constexpr std::string_view filter_name(Filter filter)
{
    switch (filter) {
    case Filter::nearest:
        return "nearest";
    case Filter::linear:
        return "linear";
    case Filter::hardware:
        return "hardware";
    case Filter::pcf3:
        return "pcf3";
    case Filter::pcf5:
        return "pcf5";
    case Filter::pcf7:
        return "pcf7";
    case Filter::pcf9:
        return "pcf9";
    case Filter::bilinear3:
        return "bilinear3";
    case Filter::bilinear5:
        return "bilinear5";
    case Filter::bilinear7:
        return "bilinear7";
    }
    return {};
}

/// How many filters there are: enumerators count from 0, and each has a name.
inline constexpr std::size_t filter_count = [] {
    std::size_t count = 0;
    while (!filter_name(static_cast<Filter>(count)).empty()) {
        ++count;
    }
    return count;
}();

} // namespace gnomon::scene
