#pragma once

#include "scene/camera/camera.hpp"
#include "scene/case/space.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// A way to mix up axes: axis i of one space is ±axis `axes[i]` of the other.
using MixedAxes = std::array<scene::CaseSpace::Axis, 3>;

/// The vector with its axes mixed up.
[[nodiscard]] scene::Vec3d mixed(const MixedAxes& axes, const scene::Vec3d& v);
/// Whether mixing mirrors.
[[nodiscard]] bool mirrors(const MixedAxes& axes);
/// `first`, then `second`, as one mixing.
[[nodiscard]] MixedAxes mixed_twice(const MixedAxes& first, const MixedAxes& second);
/// ["x", "-z", "y"], as case.toml writes it.
[[nodiscard]] std::string axes_text(const MixedAxes& axes);

/// All 48, the likeliest mistakes first: none, z up, one axis mirrored, y and z swapped, ….
[[nodiscard]] const std::vector<MixedAxes>& all_axes();

/// A way to mix up units.
struct UnitMistake {
    double factor = 1; ///< P is too large by this factor
    std::string_view words;
};
/// The first has factor 1 and is no mistake; the others ascend by their factor.
[[nodiscard]] const std::vector<UnitMistake>& unit_mistakes();

/// A space that turns with the camera, by the directions of its axes.
struct ViewSpace {
    scene::Vec3d x;
    scene::Vec3d y;
    scene::Vec3d z;

    [[nodiscard]] scene::Vec3d turned_back(const scene::Vec3d& point) const
    {
        return point.x * x + point.y * y + point.z * z;
    }
};
/// The view spaces of a camera: x to the right, y up (as in GL and Direct3D) or down, z backward or
/// forward.
[[nodiscard]] std::vector<ViewSpace> view_spaces(const scene::Camera& camera);

/// A way to flip an image.
struct Flip {
    bool rows = false;
    bool columns = false;

    [[nodiscard]] std::string_view words() const
    {
        return rows && columns ? "rows and columns" : rows ? "rows" : "columns";
    }
    template <typename Pixel>
    [[nodiscard]] const Pixel& read(const scene::Image<Pixel>& image, int x, int y) const
    {
        const auto [width, height] = image.size();
        return image(columns ? width - 1 - x : x, rows ? height - 1 - y : y);
    }
    template <typename Pixel>
    [[nodiscard]] scene::Image<Pixel> flipped(const scene::Image<Pixel>& image) const
    {
        const auto [width, height] = image.size();
        scene::Image<Pixel> result{image.size()};
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                result(x, y) = read(image, x, y);
            }
        }
        return result;
    }
};
inline constexpr std::array all_flips{Flip{true, false}, Flip{false, true}, Flip{true, true}};

} // namespace gnomon::analysis
