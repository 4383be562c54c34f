#include "analysis/evaluate/half_positions.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

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
    // Half has 10 of float32's 23 fraction bits, down to 2^-24, and ends at 65504.
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
    constexpr std::size_t fewest = 16; // a handful of pixels says nothing
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

} // namespace gnomon::analysis
