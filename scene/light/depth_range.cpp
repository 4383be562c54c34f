#include "scene/light/depth_range.hpp"

namespace gnomon::scene {

namespace {

Vec2d perspective_row(double n, double f, bool reversed, bool zero_to_one)
{
    if (zero_to_one) {
        return reversed ? Vec2d{-n / (f - n), n * f / (f - n)}
                        : Vec2d{f / (f - n), -f * n / (f - n)};
    }
    const Vec2d standard{(f + n) / (f - n), -2.0 * f * n / (f - n)};
    return reversed ? -standard : standard;
}

Vec2d orthographic_row(double n, double f, bool reversed, bool zero_to_one)
{
    if (zero_to_one) {
        return reversed ? Vec2d{-1.0 / (f - n), f / (f - n)} : Vec2d{1.0 / (f - n), -n / (f - n)};
    }
    const Vec2d standard{2.0 / (f - n), -(f + n) / (f - n)};
    return reversed ? -standard : standard;
}

} // namespace

Vec2d clip_depth_row(const DepthRange& range)
{
    const bool zero_to_one = range.clip_range == ClipRange::zero_to_one;
    return range.projection == Projection::perspective
               ? perspective_row(range.near_m, range.far_m, range.reversed, zero_to_one)
               : orthographic_row(range.near_m, range.far_m, range.reversed, zero_to_one);
}

} // namespace gnomon::scene
