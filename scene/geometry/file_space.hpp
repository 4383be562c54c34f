#pragma once

#include "scene/vec.hpp"

#include <cstdint>
#include <string_view>

namespace gnomon::scene {

/// Which axis of a scene file points up.
enum class UpAxis : std::uint8_t { y, z };
[[nodiscard]] constexpr std::string_view up_axis_name(UpAxis axis)
{
    return axis == UpAxis::y ? "y" : "z";
}

/// Converts a scene file's coordinates: turns them so that y is up, and scales them, in double.
struct FileSpace {
    double scale = 1;
    UpAxis up = UpAxis::y;

    /// (x, y, z), or (x, z, −y) if z is up: a quarter turn about x, without mirroring.
    [[nodiscard]] Vec3d direction(const Vec3d& v) const
    {
        return up == UpAxis::y ? v : Vec3d{v.x, v.z, -v.y};
    }
    [[nodiscard]] Vec3d point(const Vec3d& p) const { return scale * direction(p); }
    [[nodiscard]] bool is_of_file() const { return scale == 1 && up == UpAxis::y; }
};

} // namespace gnomon::scene
