#include "scene/camera/camera.hpp"

#include "scene/error.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::scene {
namespace {

const Box unit_box{Vec3d{-1}, Vec3d{1}};

CameraSettings looking_down_minus_z()
{
    return {.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}, .vertical_fov_deg = 90};
}

Vec3d project(const Mat4d& clip_from_world, const Vec3d& p)
{
    const Vec4d clip = clip_from_world * Vec4d{p, 1};
    return Vec3d{clip} / clip.w;
}

TEST(Camera, HasARightHandedBasis)
{
    const Camera camera = make_camera(looking_down_minus_z());
    EXPECT_EQ(camera.forward, (Vec3d{0, 0, -1}));
    EXPECT_EQ(camera.right, (Vec3d{1, 0, 0}));
    EXPECT_EQ(camera.up, (Vec3d{0, 1, 0}));
    EXPECT_DOUBLE_EQ(camera.half_height, 1.0);
}

TEST(Camera, RoundsItsEyeToFloat32)
{
    CameraSettings settings = looking_down_minus_z();
    settings.eye = {0.1, 0.2, 5};
    EXPECT_EQ(make_camera(settings).eye.x, double{0.1F});
}

TEST(Camera, RefusesEyeAtTargetAndUpAlongTheView)
{
    CameraSettings at_target = looking_down_minus_z();
    at_target.target = at_target.eye;
    EXPECT_THROW((void)make_camera(at_target), InputError);
    CameraSettings along = looking_down_minus_z();
    along.up = {0, 0, -2};
    EXPECT_THROW((void)make_camera(along), InputError);
    along.up = {0, 0, 0};
    EXPECT_THROW((void)make_camera(along), InputError);
}

TEST(PixelRay, OfTheMiddlePixelIsForward)
{
    const Camera camera = make_camera(looking_down_minus_z());
    const Ray ray = pixel_ray(camera, {3, 3}, 1, 1);
    EXPECT_EQ(ray.origin, camera.eye);
    EXPECT_EQ(ray.direction, camera.forward);
}

TEST(PixelRay, OfTheTopLeftPixelPointsUpAndLeft)
{
    const Camera camera = make_camera(looking_down_minus_z());
    // W = 4, H = 2: sx = (2·½/4 − 1)·2·1 = −1.5, sy = 1 − 2·½/2 = ½.
    const Ray ray = pixel_ray(camera, {4, 2}, 0, 0);
    EXPECT_DOUBLE_EQ(ray.direction.x, -1.5);
    EXPECT_DOUBLE_EQ(ray.direction.y, 0.5);
    EXPECT_DOUBLE_EQ(ray.direction.z, -1);
}

TEST(PixelRay, OfAnOrthographicCameraStartsBesideTheEye)
{
    CameraSettings settings = looking_down_minus_z();
    settings.projection = Projection::orthographic;
    settings.orthographic_height_m = 4;
    const Camera camera = make_camera(settings);
    const Ray ray = pixel_ray(camera, {2, 2}, 0, 0); // sx = −½·2, sy = ½·2
    EXPECT_EQ(ray.origin, (Vec3d{-1, 1, 5}));
    EXPECT_EQ(ray.direction, camera.forward);
}

TEST(CameraMatrix, ProjectsPointsOfAPixelRayToItsCentre)
{
    const ImageSize image{64, 36};
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        CameraSettings settings{.eye = {3, 2, 4}, .target = {0, 0.5, 0}};
        settings.projection = projection;
        const Camera camera = make_camera(settings);
        const Mat4d matrix = camera_clip_from_world(camera, image, unit_box);
        for (const auto& [x, y] : {std::pair{0, 0}, {63, 0}, {10, 30}, {32, 18}}) {
            const Ray ray = pixel_ray(camera, image, x, y);
            const Vec3d ndc = project(matrix, ray.origin + 3.0 * ray.direction);
            // A dozen double roundings of numbers below 10.
            EXPECT_NEAR((ndc.x * 0.5 + 0.5) * image.width_px, x + 0.5, 1e-11);
            EXPECT_NEAR((0.5 - ndc.y * 0.5) * image.height_px, y + 0.5, 1e-11);
        }
    }
}

TEST(CameraMatrix, HasReversedDepthFromTheNearPlane)
{
    const Camera camera = make_camera(looking_down_minus_z());
    const Mat4d matrix = camera_clip_from_world(camera, {2, 2}, unit_box);
    const double near_m = receiver_near_m(unit_box);
    EXPECT_DOUBLE_EQ(near_m, 1e-6 * std::sqrt(12.0));
    // Rounded at the eye's distance of 5 m, seen from near: 5·2^-53 / near.
    EXPECT_NEAR(project(matrix, {0, 0, 5 - near_m}).z, 1.0, 1e-9);
    EXPECT_NEAR(project(matrix, {0, 0, 3}).z, near_m / 2, 1e-18);
    EXPECT_GT(project(matrix, {0, 0, -1e9}).z, 0) << "there is no far plane";
}

TEST(CameraMatrix, OfAnOrthographicCameraSpansTheBox)
{
    CameraSettings settings = looking_down_minus_z();
    settings.projection = Projection::orthographic;
    const Mat4d matrix = camera_clip_from_world(make_camera(settings), {2, 2}, unit_box);
    for (const Vec3d& corner : unit_box.corners()) {
        const double depth = project(matrix, corner).z;
        EXPECT_GT(depth, 0);
        EXPECT_LT(depth, 1);
    }
    EXPECT_GT(project(matrix, {0, 0, 1}).z, project(matrix, {0, 0, -1}).z);
}

TEST(FrameBox, ShowsAllCornersAndFillsTheImage)
{
    for (const ImageSize image : {ImageSize{1280, 720}, ImageSize{300, 900}}) {
        const Box box{{-3, 0, -1}, {2, 4, 1}};
        const Camera camera = make_camera(frame_box(box, image));
        const Mat4d matrix = camera_clip_from_world(camera, image, box);
        double largest = 0;
        for (const Vec3d& corner : box.corners()) {
            const Vec3d ndc = project(matrix, corner);
            largest = std::max({largest, std::abs(ndc.x), std::abs(ndc.y)});
        }
        EXPECT_LT(largest, 1.0);
        EXPECT_GT(largest, 0.85);
    }
}

} // namespace
} // namespace gnomon::scene
