#include "scene/camera/camera.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::scene {
namespace {

/// Beyond this the view direction and `up` do not span a plane in double.
constexpr double smallest_sine = 1e-9;

Vec4d row(const Vec3d& axis, double offset)
{
    return {axis.x, axis.y, axis.z, offset};
}

/// The matrix whose rows are x, y, z, w.
Mat4d matrix_of_rows(const Vec4d& x, const Vec4d& y, const Vec4d& z, const Vec4d& w)
{
    return glm::transpose(Mat4d{x, y, z, w});
}

/// Far plane of an orthographic camera [m]: a little behind the box's farthest corner.
double orthographic_far_m(const Camera& camera, const Box& box, double near_m)
{
    double farthest_m = near_m;
    for (const Vec3d& corner : box.corners()) {
        farthest_m = std::max(farthest_m, glm::dot(camera.forward, corner - camera.eye));
    }
    return farthest_m + 1e-3 * box.diagonal_m();
}

} // namespace

Camera make_camera(const CameraSettings& settings)
{
    Camera camera;
    camera.projection = settings.projection;
    camera.eye = rounded_to_float32(settings.eye);
    const Vec3d view = settings.target - camera.eye;
    if (!(glm::length(view) > 0)) {
        throw InputError("camera.eye equals camera.target: move one of them");
    }
    camera.forward = glm::normalize(view);
    const Vec3d across = glm::cross(camera.forward, settings.up);
    if (!(glm::length(across) > smallest_sine * glm::length(settings.up))) {
        throw InputError("camera.up is zero or parallel to the view: choose another up direction");
    }
    camera.right = glm::normalize(across);
    camera.up = glm::cross(camera.right, camera.forward);
    camera.half_height = settings.projection == Projection::perspective
                             ? std::tan(0.5 * glm::radians(settings.vertical_fov_deg))
                             : 0.5 * settings.orthographic_height_m;
    return camera;
}

CameraSettings frame_box(const Box& box, ImageSize image)
{
    constexpr double margin = 0.92; // of the image's half size, left free around the corners
    CameraSettings settings;
    const Vec3d centre = box.centre();
    const Vec3d backward = glm::normalize(Vec3d{0.45, 0.5, 0.8});
    const Vec3d right = glm::normalize(glm::cross(settings.up, backward));
    const Vec3d up = glm::cross(backward, right);
    const double half_height = margin * std::tan(0.5 * glm::radians(settings.vertical_fov_deg));
    const double half_width = half_height * image.width_px / image.height_px;
    double distance_m = 1e-3 * box.diagonal_m();
    for (const Vec3d& corner : box.corners()) {
        const Vec3d q = corner - centre;
        const double needed_m = std::max(std::abs(glm::dot(q, right)) / half_width,
                                         std::abs(glm::dot(q, up)) / half_height);
        distance_m = std::max(distance_m, needed_m + glm::dot(q, backward));
    }
    settings.eye = centre + distance_m * backward;
    settings.target = centre;
    return settings;
}

double pixel_sx(const Camera& camera, ImageSize image, int x)
{
    const double width = image.width_px;
    const double height = image.height_px;
    const double aspect = width / height;
    return (2.0 * (x + 0.5) / width - 1.0) * aspect * camera.half_height;
}

double pixel_sy(const Camera& camera, ImageSize image, int y)
{
    const double height = image.height_px;
    return (1.0 - 2.0 * (y + 0.5) / height) * camera.half_height;
}

Ray pixel_ray(const Camera& camera, ImageSize image, int x, int y)
{
    return pixel_ray(camera, pixel_sx(camera, image, x), pixel_sy(camera, image, y));
}

double receiver_near_m(const Box& box)
{
    return 1e-6 * box.diagonal_m();
}

Mat4d camera_clip_from_world(const Camera& camera, ImageSize image, const Box& box)
{
    const double half_width = camera.half_height * image.width_px / image.height_px;
    const double near_m = receiver_near_m(box);
    const auto plane = [&](const Vec3d& axis, double scale) {
        return row(scale * axis, -scale * glm::dot(axis, camera.eye));
    };
    const Vec4d x = plane(camera.right, 1.0 / half_width);
    const Vec4d y = plane(camera.up, 1.0 / camera.half_height);
    const Vec4d light_distance = plane(camera.forward, 1.0);
    if (camera.projection == Projection::perspective) {
        return matrix_of_rows(x, y, Vec4d{0, 0, 0, near_m}, light_distance);
    }
    const double far_m = orthographic_far_m(camera, box, near_m);
    const Vec4d depth = (Vec4d{0, 0, 0, far_m} - light_distance) / (far_m - near_m);
    return matrix_of_rows(x, y, depth, Vec4d{0, 0, 0, 1});
}

} // namespace gnomon::scene
