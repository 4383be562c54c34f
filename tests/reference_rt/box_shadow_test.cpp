#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

/// A box on a plane against its analytic shadow polygon.
namespace gnomon::reference_rt::test {
namespace {

const Vec3d box_lower{-0.5, 0, -0.25};
const Vec3d box_upper{0.5, 0.75, 0.5};

TriangleScene box_on_ground(int cells, const Vec3d& shift = Vec3d{0})
{
    SceneBuilder centred;
    add_ground(centred, 4, cells);
    add_box(centred, box_lower, box_upper);
    TriangleScene scene = centred.take();
    for (scene::Vec3f& vertex : scene.vertices) {
        vertex += scene::Vec3f{shift};
    }
    return scene;
}

double cross2(const Vec2d& a, const Vec2d& b)
{
    return a.x * b.y - a.y * b.x;
}

/// Counter-clockwise hull (Andrew's monotone chain).
std::vector<Vec2d> convex_hull(std::vector<Vec2d> points)
{
    std::ranges::sort(
        points, [](const Vec2d& a, const Vec2d& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::vector<Vec2d> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const Vec2d& point : points) {
            while (hull.size() >= start + 2 &&
                   cross2(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0) {
                hull.pop_back();
            }
            hull.push_back(point);
        }
        hull.pop_back();
        std::ranges::reverse(points);
    }
    return hull;
}

/// Where the ray from the light through a corner reaches the ground: (x, z) [m].
Vec2d shadow_of(const Vec3d& corner, const scene::Light& light)
{
    const Vec3d step =
        light.type == scene::LightType::directional ? light.direction : corner - light.position;
    const Vec3d reached = corner - corner.y / step.y * step;
    return {reached.x, reached.z};
}

/// The box's shadow on the ground, (x, z): the hull of its corners' shadows.
std::vector<Vec2d> shadow_polygon(const scene::Light& light)
{
    std::vector<Vec2d> points;
    for (const Vec3d& corner : scene::Box{box_lower, box_upper}.corners()) {
        points.push_back(shadow_of(corner, light));
    }
    return convex_hull(points);
}

/// A ground point in the image, homogeneous [px], seen from the pixel's centre.
Vec3d image_of(const Vec2d& ground, const View& view, const Vec2d& centre)
{
    const Vec3d q = Vec3d{ground.x, 0, ground.y} - view.camera.eye;
    const bool is_perspective = view.camera.projection == scene::Projection::perspective;
    const double w = is_perspective ? glm::dot(q, view.camera.forward) : 1.0;
    const double half = 0.5 * view.image.height_px;
    const double scale = half / view.camera.half_height;
    return {scale * glm::dot(q, view.camera.right) + (0.5 * view.image.width_px - centre.x) * w,
            -scale * glm::dot(q, view.camera.up) + (half - centre.y) * w, w};
}

/// Signed distance of a pixel's centre from the polygon's border in the image, positive inside;
/// outside it is at most the true distance. `point` is what the pixel shows of the ground.
double depth_inside_px(const std::vector<Vec2d>& polygon, const Vec2d& point, const View& view,
                       const Vec2d& centre)
{
    double inside = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2d& from = polygon[i];
        const Vec2d& to = polygon[(i + 1) % polygon.size()];
        const Vec3d line = glm::cross(image_of(from, view, centre), image_of(to, view, centre));
        const double distance_px = std::abs(line.z) / std::hypot(line.x, line.y);
        inside = std::min(inside, std::copysign(distance_px, cross2(to - from, point - from)));
    }
    return inside;
}

struct Comparison {
    int blocked = 0; ///< ground pixels that are in shadow
    int lit = 0;
    int wrong = 0;  ///< against the polygon, beyond the tolerance
    int others = 0; ///< ground pixels that are neither
};

/// Compares the ground pixels with the polygon.
Comparison compare(const scene::Truth& truth, const Image<std::uint32_t>& receivers,
                   const View& view, std::uint32_t ground_triangles, double tolerance_px)
{
    const auto polygon = shadow_polygon(view.light);
    Comparison result;
    for (int y = 0; y < view.image.height_px; ++y) {
        for (int x = 0; x < view.image.width_px; ++x) {
            if (receivers(x, y) >= ground_triangles) {
                continue;
            }
            const scene::Ray ray = scene::pixel_ray(view.camera, view.image, x, y);
            const Vec3d point = ray.origin - ray.origin.y / ray.direction.y * ray.direction;
            const double inside =
                depth_inside_px(polygon, {point.x, point.z}, view, {x + 0.5, y + 0.5});
            const bool is_blocked = truth.pixel_class(x, y) == PixelClass::blocked;
            const bool is_lit = truth.pixel_class(x, y) == PixelClass::lit;
            result.blocked += is_blocked;
            result.lit += is_lit;
            result.others += !is_blocked && !is_lit && std::abs(inside) > tolerance_px;
            result.wrong +=
                (is_blocked && inside < -tolerance_px) || (is_lit && inside > tolerance_px);
        }
    }
    return result;
}

/// P and the ray are rounded to float32 for the traversal: half an ulp of 4 m is 2.4e-7 m, and a
/// pixel is no smaller than 1 mm here.
constexpr double tolerance_px = 1e-3;

constexpr ImageSize box_image{160, 120};
constexpr ImageSize small{80, 60}; // where the ground has many triangles

struct Lighting {
    std::string_view name;
    View view;

    friend void PrintTo(const Lighting& shown, std::ostream* out) { *out << shown.name; }
};

class BoxShadow : public testing::TestWithParam<Lighting> {};

TEST_P(BoxShadow, EqualsTheAnalyticPolygon)
{
    const View& view = GetParam().view;
    const TriangleScene scene = box_on_ground(1);
    const auto receivers = brute_force_receivers(scene, view);
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
    const Comparison result = compare(truth, receivers, view, 2, tolerance_px);
    EXPECT_EQ(result.wrong, 0);
    EXPECT_EQ(result.others, 0);
    EXPECT_GT(result.blocked, 200);
    EXPECT_GT(result.lit, 200);
}

INSTANTIATE_TEST_SUITE_P(
    Views, BoxShadow,
    testing::Values(
        Lighting{"high sun",
                 make_view({2, 2.5, 3}, {0, 0, 0}, box_image, directional({0.4, -1, 0.3}))},
        Lighting{"low sun",
                 make_view({2, 2.5, 3}, {0, 0, 0}, box_image, directional({1, -0.35, 0.2}))},
        Lighting{"along an axis",
                 make_view({2, 2.5, 3}, {0, 0, 0}, box_image, directional({0.7, -1, 0}))},
        Lighting{"sideways",
                 make_view({-1, 3, 3}, {0, 0, 0}, box_image, directional({-1, -0.5, 1}))},
        // The box's foot from near: a pixel is about 3 mm.
        Lighting{"foot",
                 make_view({0.9, 0.3, 0.9}, {0.5, 0, 0.25}, box_image, directional({1, -1, 0.1}))},
        Lighting{"corner", make_view({0.9, 0.3, 0.9}, {0.5, 0, 0.25}, box_image,
                                     directional({0.2, -0.4, 1}))},
        Lighting{"spot", make_view({2, 2.5, 3}, {0, 0, 0}, box_image,
                                   spot({-1.5, 3, 0.5}, {0, 0, 0}, 170))},
        Lighting{"spot at the foot", make_view({0.9, 0.3, 0.9}, {0.5, 0, 0.25}, box_image,
                                               spot({-1.5, 3, 0}, {0, 0, 0}, 170))},
        Lighting{"orthographic",
                 make_view({2, 2.5, 3}, {0, 0, 0}, box_image, directional({0.4, -1, 0.3}),
                           scene::Projection::orthographic)}));

TEST(BoxShadowOnTiles, IsNotBrokenByCoplanarNeighbours)
{
    constexpr int cells = 64;
    const TriangleScene scene = box_on_ground(cells);
    const View view = make_view({2, 2.5, 3}, {0, 0, 0}, small, directional({1, -0.1, 0.2}));
    const auto receivers = brute_force_receivers(scene, view);
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
    const Comparison result = compare(truth, receivers, view, 2 * cells * cells, tolerance_px);
    EXPECT_EQ(result.wrong, 0);
    EXPECT_EQ(result.others, 0);
    EXPECT_GT(result.lit, 300);
}

TEST(BoxShadowFarAway, KeepsItsPolygonWithinTheRaysRounding)
{
    constexpr int cells = 64;
    const Vec3d shift{1000, -1000, 500};
    const TriangleScene scene = box_on_ground(cells, shift);
    const View near = make_view({2, 2.5, 3}, {0, 0, 0}, small, directional({1, -0.5, 0.2}));
    View far = near;
    far.camera.eye += shift;
    const auto receivers = brute_force_receivers(scene, far);
    const auto truth = compute_truth(ReferenceScene{scene}, far, receivers, {});
    // Half an ulp of float32 at 1000 is 3e-5 m, and a pixel 2 cm or more: 2e-3 px, and twice that
    // for the traversal's own rounding.
    const Comparison result = compare(truth, receivers, near, 2 * cells * cells, 5e-3);
    EXPECT_EQ(result.wrong, 0);
    EXPECT_EQ(result.others, 0);
    EXPECT_GT(result.blocked, 300);
}

} // namespace
} // namespace gnomon::reference_rt::test
