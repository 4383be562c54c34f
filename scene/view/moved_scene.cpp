#include "scene/view/moved_scene.hpp"

#include "scene/view/view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::scene {

namespace {

/// The new origin along an axis: the middle of the range, rounded to the float32 step there, if 0
/// is farther away than the range is long; else 0.
double origin_along(double lower, double upper)
{
    const double middle = 0.5 * (lower + upper);
    if (std::abs(middle) <= upper - lower) {
        return 0;
    }
    const double step =
        std::ldexp(1.0, std::ilogb(std::max(std::abs(lower), std::abs(upper))) - 23);
    return std::round(middle / step) * step;
}

/// Moves points and records whether all moved exactly.
class Mover {
public:
    explicit Mover(const Vec3d& origin) : origin_{origin} {}

    void move(Vec3f& vertex)
    {
        const Vec3d exact = Vec3d{vertex} - origin_;
        vertex = Vec3f{exact};
        is_exact_ = is_exact_ && Vec3d{vertex} == exact;
    }
    void move(Vec3d& point) const { point = rounded_to_float32(point) - origin_; }
    void move(std::optional<Vec3d>& point) const
    {
        if (point) {
            move(*point);
        }
    }
    [[nodiscard]] bool is_exact() const { return is_exact_; }

private:
    Vec3d origin_;
    bool is_exact_ = true;
};

} // namespace

std::optional<MovedScene> move_origin_near(const Job& job, const SceneFile& file)
{
    const Box box = file.scene.bounds();
    const Vec3d origin{origin_along(box.lower.x, box.upper.x),
                       origin_along(box.lower.y, box.upper.y),
                       origin_along(box.lower.z, box.upper.z)};
    if (origin == Vec3d{0, 0, 0}) {
        return std::nullopt;
    }
    MovedScene moved{origin, {file.scene, {}}, job};
    Mover mover{origin};
    for (Vec3f& vertex : moved.file.scene.vertices) {
        mover.move(vertex);
    }
    CameraSettings camera = resolve_camera(job, file.scene, file.defaults);
    LightSettings light = resolve_light(job, file.defaults);
    mover.move(camera.eye);
    mover.move(camera.target);
    mover.move(light.position);
    mover.move(light.target);
    moved.job.camera = camera;
    moved.job.light = light;
    return mover.is_exact() ? std::optional{std::move(moved)} : std::nullopt;
}

} // namespace gnomon::scene
