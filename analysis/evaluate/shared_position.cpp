#include "analysis/evaluate/shared_position.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>

namespace gnomon::analysis {

std::optional<ImportMistake> check_shared_position(std::span<const scene::Vec3d> points)
{
    constexpr std::size_t fewest = 16;
    std::map<std::tuple<double, double, double>, std::size_t> counts;
    for (const scene::Vec3d& p : points) {
        ++counts[{p.x, p.y, p.z}];
    }
    std::size_t most = 0;
    std::size_t next = 0;
    std::tuple<double, double, double> place;
    for (const auto& [position, count] : counts) {
        next = std::max(next, std::min(most, count));
        if (count > most) {
            most = count;
            place = position;
        }
    }
    if (most < fewest || most * 100 < points.size() || most < 10 * next) {
        return std::nullopt;
    }
    const auto [x, y, z] = place;
    const double share = static_cast<double>(most) / static_cast<double>(points.size());
    return ImportMistake{
        "background",
        fmt::format("{:.2g} % of the pixels have the very same position ({:.6g}, {:.6g}, {:.6g}), "
                    "as pixels that show nothing do: write valid = 0 where nothing is seen, or set "
                    "conventions.background",
                    100 * share, x, y, z)};
}

} // namespace gnomon::analysis
