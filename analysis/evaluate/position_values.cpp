#include "analysis/evaluate/case_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

namespace gnomon::analysis {

namespace {

using scene::Vec3f;

bool is_half_vector(const Vec3f& v)
{
    return is_half(v.x) && is_half(v.y) && is_half(v.z);
}

/// How positions step from pixel to pixel along rows.
struct RowSteps {
    std::size_t pairs = 0;
    std::size_t repeated = 0;
    std::size_t triples = 0;
    std::size_t even = 0;
};

RowSteps count_steps(const scene::Image<Vec3f>& position)
{
    RowSteps steps;
    const auto [width, height] = position.size();
    for (int y = 0; y < height; ++y) {
        for (int x = 1; x < width; ++x) {
            const Vec3f step = position(x, y) - position(x - 1, y);
            if (std::isnan(step.x)) {
                continue;
            }
            ++steps.pairs;
            steps.repeated += step == Vec3f{0.0F} ? 1U : 0U;
            const Vec3f last = x > 1 ? position(x - 1, y) - position(x - 2, y) : Vec3f{NAN};
            if (!std::isnan(last.x)) {
                ++steps.triples;
                steps.even += step == last ? 1U : 0U;
            }
        }
    }
    return steps;
}

} // namespace

bool is_half(float value)
{
    // Half has 10 of float32's 23 fraction bits, a smallest step of 2^-24, and a largest value of
    // 65504.
    constexpr float largest = 65504;
    constexpr float smallest_step = 0x1p-24F;
    const float size = std::abs(value);
    if (!(size <= largest)) {
        return false;
    }
    if (size < 0x1p-14F) {
        return size / smallest_step == std::floor(size / smallest_step);
    }
    constexpr std::uint32_t beyond_half = (1U << 13U) - 1;
    return (std::bit_cast<std::uint32_t>(value) & beyond_half) == 0;
}

bool are_rounded_to_half(const scene::Image<Vec3f>& position, bool is_off_surfaces)
{
    constexpr std::size_t fewest = 16; // fewer pixels prove nothing
    std::size_t judged = 0;
    for (const Vec3f& p : position) {
        if (!std::isnan(p.x)) {
            if (!is_half_vector(p)) {
                return false;
            }
            ++judged;
        }
    }
    if (judged < fewest) {
        return false;
    }
    const RowSteps steps = count_steps(position);
    const bool repeats = steps.repeated * 100 >= steps.pairs && steps.repeated > 0;
    const bool is_even = steps.triples > 0 && steps.even * 2 >= steps.triples;
    return is_off_surfaces || repeats || !is_even;
}

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
