// The splits of a camera's view, and the maps of its slices.

#include "scene/error.hpp"
#include "scene/light/cascades.hpp"
#include "scene/light/map_choice.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

namespace gnomon::scene {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr ImageSize image{32, 18};

/// Triangles all over the ground around the origin.
TriangleScene scattered_triangles()
{
    std::mt19937 random{3};
    std::uniform_real_distribution<double> metres{-40, 40};
    SceneBuilder builder;
    for (int i = 0; i < 60; ++i) {
        const Vec3d at{metres(random), 0.1 * metres(random), metres(random)};
        const std::vector<Vec3d> corners{at, at + Vec3d{1, 0, 0.2}, at + Vec3d{0, 1, 0.3}};
        builder.add(fmt::format("t{}", i), corners,
                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    return builder.take();
}

Camera camera_at(const Vec3d& eye, const Vec3d& target, Projection projection)
{
    CameraSettings settings;
    settings.eye = eye;
    settings.target = target;
    settings.projection = projection;
    settings.vertical_fov_deg = 50;
    settings.orthographic_height_m = 6;
    return make_camera(settings);
}

/// A directional light with cascades for a camera, and all inputs of the fit.
struct Sun {
    CascadeSettings cascades;
    FrustumSettings frustum;
    LightSettings settings;
    TriangleScene scene = scattered_triangles();
    Camera camera = camera_at({0, 2, 10}, {0, 1, 0}, Projection::perspective);
    int resolution_texels = 256;

    explicit Sun(const Vec3d& direction = {0.3, -1, -0.5}) { settings.direction = direction; }
    [[nodiscard]] std::vector<double> splits() const
    {
        return split_view(cascades, scene, camera, image);
    }
    [[nodiscard]] std::vector<LightFrustum> maps() const
    {
        return fit_cascades({cascades, frustum, settings, make_light(settings), scene, camera,
                             image, resolution_texels},
                            splits());
    }
};

/// The corners of a slice of the camera's view.
std::vector<Vec3d> corners(const Camera& camera, double begin_m, double end_m)
{
    std::vector<Vec3d> all;
    for (const double depth_m : {begin_m, end_m}) {
        const double scale = camera.projection == Projection::perspective ? depth_m : 1;
        for (const double x : {-1, 1}) {
            for (const double y : {-1, 1}) {
                all.push_back(camera.eye + depth_m * camera.forward +
                              x * scale * camera.half_height * image.width_px / image.height_px *
                                  camera.right +
                              y * scale * camera.half_height * camera.up);
            }
        }
    }
    return all;
}

/// The largest |x| or |y| of a point in clip space.
double largest_side(const LightFrustum& map, const Vec3d& point)
{
    const Vec4d clip = map.light_clip_from_world_exact * Vec4d{point, 1};
    return std::max(std::abs(clip.x), std::abs(clip.y));
}

TEST(TheView, IsSplitAsTheFormulasSay)
{
    Sun sun;
    sun.cascades.near_m = 1;
    sun.cascades.far_m = 16;
    sun.cascades.split = CascadeSplit::uniform;
    EXPECT_EQ(sun.splits(), (std::vector<double>{1, 4.75, 8.5, 12.25, 16}));
    sun.cascades.split = CascadeSplit::logarithmic;
    EXPECT_EQ(sun.splits(), (std::vector<double>{1, 2, 4, 8, 16}));
    sun.cascades.split = CascadeSplit::practical;
    EXPECT_EQ(sun.splits(), (std::vector<double>{1, 3.375, 6.25, 10.125, 16}));
    sun.cascades.count = 2;
    sun.cascades.split_lambda = 1;
    EXPECT_EQ(sun.splits(), (std::vector<double>{1, 4, 16}));
}

TEST(TheView, IsSplitFromTheNearestToTheFarthestInSight)
{
    SceneBuilder builder;
    builder.add("near", std::vector<Vec3d>{{-1, 0, 7}, {1, 0, 7}, {0, 1, 7}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    builder.add("far", std::vector<Vec3d>{{-1, 0, -6}, {1, 0, -6}, {0, 1, -6}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    builder.add("behind", std::vector<Vec3d>{{-1, 0, 40}, {1, 0, 40}, {0, 1, 40}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    Sun sun;
    sun.scene = builder.take();
    sun.camera = camera_at({0, 0.5, 10}, {0, 0.5, 0}, Projection::perspective);
    EXPECT_DOUBLE_EQ(sun.splits().front(), 3);
    EXPECT_DOUBLE_EQ(sun.splits().back(), 16);
    sun.cascades.near_m = 20;
    EXPECT_THAT(
        [&] { (void)sun.splits(); },
        ThrowsMessage<InputError>(HasSubstr(
            "shadow_map.cascade_near = 20 is not below shadow_map.cascade_far = 16 (that of "
            "the farthest receiver in view)")));
    sun.camera = camera_at({0, 0.5, 10}, {0, 100, 10.001}, Projection::perspective);
    sun.cascades.near_m = {};
    EXPECT_LT(sun.splits().front(), sun.splits().back()); // it sees nothing
}

TEST(ATightCascade, HasTheBoxAroundItsSliceAndNoMore)
{
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        Sun sun;
        sun.camera = camera_at({3, 4, 12}, {0, 1, 0}, projection);
        sun.frustum.roll_deg = 20;
        sun.cascades.blend = 0.25;
        const std::vector<double> splits = sun.splits();
        const auto maps = sun.maps();
        ASSERT_EQ(maps.size(), 4U);
        for (std::size_t i = 0; i < maps.size(); ++i) {
            const double begin_m =
                i == 0 ? splits[0] : splits[i] - 0.25 * (splits[i] - splits[i - 1]);
            double reach = 0;
            for (const Vec3d& corner : corners(sun.camera, begin_m, splits[i + 1])) {
                reach = std::max(reach, largest_side(maps[i], corner));
            }
            // Each of some ten roundings of numbers no larger than 100 widths.
            EXPECT_NEAR(reach, 1, 1e-12);
            EXPECT_EQ(maps[i].origin, maps[0].origin);
            EXPECT_EQ(maps[i].forward, maps[0].forward);
        }
    }
}

TEST(AStabilisedCascade, HoldsASphereAroundItsSlice)
{
    std::mt19937 random{5};
    std::uniform_real_distribution<double> metres{-30, 30};
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        Sun sun;
        sun.cascades.fit = CascadeFit::stabilised;
        sun.cascades.near_m = 0.5;
        sun.cascades.far_m = 60;
        for (int i = 0; i < 100; ++i) {
            sun.camera = camera_at({metres(random), metres(random), metres(random)},
                                   {metres(random), metres(random), metres(random)}, projection);
            const std::vector<double> splits = sun.splits();
            const auto maps = sun.maps();
            for (std::size_t m = 0; m < maps.size(); ++m) {
                double reach = 0;
                for (const Vec3d& corner : corners(sun.camera, splits[m], splits[m + 1])) {
                    reach = std::max(reach, largest_side(maps[m], corner));
                }
                EXPECT_LE(reach, 1);
            }
        }
    }
}

std::uint32_t bits(float value)
{
    return std::bit_cast<std::uint32_t>(value);
}

/// A stabilised sun before a camera that walks.
class WalkingCamera {
public:
    WalkingCamera()
    {
        sun.cascades.fit = CascadeFit::stabilised;
        sun.cascades.near_m = 0.5;
        sun.cascades.far_m = 60;
    }
    void step()
    {
        std::uniform_real_distribution<double> metres{-1, 1};
        eye_ += Vec3d{metres(random_), 0.1 * metres(random_), metres(random_)};
        const Vec3d way{metres(random_), 0.3 * metres(random_), metres(random_)};
        sun.camera = camera_at(eye_, eye_ + way, Projection::perspective);
    }

    Sun sun;

private:
    std::mt19937 random_{7};
    Vec3d eye_{0, 2, 10};
};

TEST(AStabilisedCascade, MovesByWholeTexelsAndKeepsItsRows)
{
    WalkingCamera walk;
    const auto first = walk.sun.maps();
    const double half = walk.sun.resolution_texels / 2.0;
    for (int step = 0; step < 1000; ++step) {
        walk.step();
        const auto maps = walk.sun.maps();
        for (std::size_t m = 0; m < maps.size(); ++m) {
            const Mat4f& before = first[m].light_clip_from_world;
            const Mat4f& now = maps[m].light_clip_from_world;
            for (int row = 0; row < 4; ++row) {
                for (int column = 0; column < 3; ++column) {
                    ASSERT_EQ(bits(now[column][row]), bits(before[column][row]))
                        << "step " << step << ", map " << m;
                }
            }
            for (int row = 0; row < 2; ++row) {
                const double texels = double{now[3][row]} * half;
                ASSERT_EQ(texels, std::round(texels)) << "step " << step << ", map " << m;
                ASSERT_LT(std::abs(texels), 0x1p24);
            }
            ASSERT_EQ(bits(now[3][2]), bits(before[3][2]));
        }
    }
}

/// A point's texel in the float32 lookup, counted from the world's origin, and a bound on its
/// rounding error.
struct WorldTexel {
    double texel = 0; ///< uv · N of the map, minus the grid's translation
    /// (4·(S + |t|) + 1)·2^-24·N/2, S the row's sum of absolute products: products and sums round,
    /// and then u = x/2 + 1/2 in [0, 1].
    double largest_off = 0;
};

WorldTexel texel_of(const Mat4f& matrix, int row, const Vec3f& point, int resolution)
{
    const Vec4f clip = clip_position(matrix, point);
    const float uv = clip[row] * 0.5F + 0.5F;
    double sum = std::abs(double{matrix[3][row]});
    for (int column = 0; column < 3; ++column) {
        sum += std::abs(double{matrix[column][row]} * double{point[column]});
    }
    const double half = resolution / 2.0;
    return {double{uv * static_cast<float>(resolution)} - half * double{matrix[3][row]},
            (4 * sum + 1) * 0x1p-24 * half};
}

/// The nearest point on a border between columns of texels, up to its rounding.
Vec3f on_border(const LightFrustum& map, const Vec3f& point, int resolution)
{
    const double texel = texel_of(map.light_clip_from_world, 0, point, resolution).texel;
    const double texel_m = map.texel_width_m(1, resolution);
    return Vec3f{Vec3d{point} + (std::round(texel) - texel) * texel_m * map.right};
}

TEST(AStabilisedCascade, FindsWorldPointsInTheirTexelButNextToItsBorders)
{
    WalkingCamera walk;
    const auto first = walk.sun.maps();
    const int resolution = walk.sun.resolution_texels;
    std::mt19937 random{9};
    std::uniform_real_distribution<float> metres{-30, 30};
    std::vector<Vec3f> points;
    for (std::size_t i = 0; i < 64; ++i) {
        const Vec3f anywhere{metres(random), 0.1F * metres(random), metres(random)};
        points.push_back(on_border(first[i % 4], anywhere, resolution));
    }
    std::size_t compared = 0;
    std::size_t moved = 0;
    for (int step = 0; step < 1000; ++step) {
        walk.step();
        const auto maps = walk.sun.maps();
        for (std::size_t m = 0; m < maps.size(); ++m) {
            for (const Vec3f& point : points) {
                for (int row = 0; row < 2; ++row) {
                    const WorldTexel before =
                        texel_of(first[m].light_clip_from_world, row, point, resolution);
                    const WorldTexel now =
                        texel_of(maps[m].light_clip_from_world, row, point, resolution);
                    ++compared;
                    if (std::floor(before.texel) != std::floor(now.texel)) {
                        ++moved;
                        const double border =
                            std::max(std::floor(before.texel), std::floor(now.texel));
                        ASSERT_LE(std::abs(now.texel - border), now.largest_off)
                            << "step " << step << ", map " << m;
                    }
                }
            }
        }
    }
    EXPECT_EQ(compared, 1000U * 4 * 64 * 2);
    EXPECT_GT(moved, 0U);
    EXPECT_LT(moved, compared / 10);
}

TEST(TheSliceOfAPoint, IsTheFirstThatEndsBeyondIt)
{
    const ViewSlices slices{{0, 0, 10}, {0, 0, -1}, {2, 4, 8}};
    EXPECT_EQ(slices.slice_of({5, 5, 10}), 0U);
    EXPECT_EQ(slices.slice_of({0, 0, 8.5F}), 0U);
    EXPECT_EQ(slices.slice_of({0, 0, 8}), 1U); // its end is the next one's
    EXPECT_EQ(slices.slice_of({0, 0, 5}), 2U);
    EXPECT_EQ(slices.slice_of({0, 0, -50}), 2U); // beyond all: the last
    EXPECT_EQ(slices.slice_of({0, 0, 12}), 0U);  // behind the camera
}

} // namespace
} // namespace gnomon::scene
