#include "analysis/pixels/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace gnomon::analysis {

void require_equal_sizes(std::string_view function, scene::ImageSize size,
                         std::initializer_list<scene::ImageSize> others)
{
    if (std::ranges::any_of(others, [&](scene::ImageSize other) { return other != size; })) {
        throw std::invalid_argument(fmt::format("{}: the images differ in size", function));
    }
}

void require_ascending(std::string_view function, std::span<const float> biases)
{
    if (std::ranges::adjacent_find(biases, std::greater_equal<>{}) != biases.end()) {
        throw std::invalid_argument(fmt::format("{}: biases: must ascend", function));
    }
}

} // namespace gnomon::analysis
