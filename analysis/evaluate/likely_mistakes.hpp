#pragma once

#include "scene/camera/camera.hpp"
#include "scene/case/space.hpp"
#include "scene/vec.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// A way in which axes may be mixed up: axis i of the one is ±axis `axes[i]` of the other.
using MixedAxes = std::array<scene::CaseSpace::Axis, 3>;

/// The vector with its axes mixed.
[[nodiscard]] scene::Vec3d mixed(const MixedAxes& axes, const scene::Vec3d& v);
/// True if mixing mirrors.
[[nodiscard]] bool mirrors(const MixedAxes& axes);
/// What `first` and then `second` do.
[[nodiscard]] MixedAxes mixed_twice(const MixedAxes& first, const MixedAxes& second);
/// ["x", "-z", "y"], as case.toml writes it.
[[nodiscard]] std::string axes_text(const MixedAxes& axes);

/// All 48, the likeliest mistakes first: none, z up, one axis mirrored, two of them swapped, ….
[[nodiscard]] const std::vector<MixedAxes>& all_axes();

/// A way in which units may be mixed up.
struct UnitMistake {
    double factor = 1; ///< P is too large by it
    std::string_view words;
};
/// The first is no mistake, of factor 1; the others ascend by their factor.
[[nodiscard]] const std::vector<UnitMistake>& unit_mistakes();

/// A space that turns with the camera: where its axes point to.
struct ViewSpace {
    scene::Vec3d x;
    scene::Vec3d y;
    scene::Vec3d z;

    [[nodiscard]] scene::Vec3d turned_back(const scene::Vec3d& point) const
    {
        return point.x * x + point.y * y + point.z * z;
    }
};
/// Those of a camera: x to the right, y up as in GL and Direct3D or down, z backward or forward.
[[nodiscard]] std::vector<ViewSpace> view_spaces(const scene::Camera& camera);

} // namespace gnomon::analysis
