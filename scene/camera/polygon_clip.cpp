#include "scene/camera/polygon_clip.hpp"

namespace gnomon::scene {
namespace {

/// Sutherland–Hodgman against one half space.
void clip_against(const std::vector<Vec3d>& polygon, const HalfSpace& half_space,
                  std::vector<Vec3d>& result)
{
    result.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& a = polygon[i];
        const Vec3d& b = polygon[(i + 1) % polygon.size()];
        const double at_a = half_space.signed_distance(a);
        const double at_b = half_space.signed_distance(b);
        if (at_a >= 0) {
            result.push_back(a);
        }
        if ((at_a >= 0) != (at_b >= 0)) {
            result.push_back(a + (at_a / (at_a - at_b)) * (b - a));
        }
    }
}

} // namespace

std::span<const Vec3d> PolygonClipper::clip(std::span<const Vec3d> polygon,
                                            std::span<const HalfSpace> half_spaces)
{
    polygon_.assign(polygon.begin(), polygon.end());
    for (const HalfSpace& half_space : half_spaces) {
        clip_against(polygon_, half_space, clipped_);
        polygon_.swap(clipped_);
    }
    return polygon_;
}

} // namespace gnomon::scene
