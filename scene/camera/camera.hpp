#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <string_view>

namespace gnomon::scene {

enum class Projection : std::uint8_t { perspective, orthographic };

/// "perspective", "orthographic".
[[nodiscard]] constexpr std::string_view projection_name(Projection projection)
{
    return projection == Projection::perspective ? "perspective" : "orthographic";
}

/// The job's `[camera]` table.
struct CameraSettings {
    Vec3d eye{0, 2, 6};
    Vec3d target{0, 0.5, 0};
    Vec3d up{0, 1, 0};
    Projection projection = Projection::perspective;
    double vertical_fov_deg = 45;     ///< (0, 180); perspective
    double orthographic_height_m = 4; ///< > 0; orthographic: world height of the image
};

/// A camera as exact input: these doubles define it.
struct Camera {
    Projection projection = Projection::perspective;
    Vec3d eye;     ///< [m], each component rounded to float32
    Vec3d forward; ///< unit length up to rounding
    Vec3d right;
    Vec3d up;
    double half_height = 0.5; ///< tan(fov/2), or half the orthographic height [m]
};

/// A ray, exactly as these doubles give it.
struct Ray {
    Vec3d origin;    ///< [m]
    Vec3d direction; ///< not normalised
};

/// Builds the camera: forward = target − eye normalised, right = forward × up, up = right ×
/// forward.
/// @throws InputError  if eye equals target after rounding to float32, or up is parallel to the
/// view.
[[nodiscard]] Camera make_camera(const CameraSettings& settings);

/// Frames the box: a three-quarter view from above in which the box's corners just fit.
[[nodiscard]] CameraSettings frame_box(const Box& box, ImageSize image);

/// The ray through the centre of pixel (x, y), (0, 0) at the top left (docs/formulas.md).
///
///     sx = (2(x+½)/W − 1)·(W/H)·half_height,   sy = (1 − 2(y+½)/H)·half_height
///     perspective:  eye,                         forward + sx·right + sy·up
///     orthographic: eye + sx·right + sy·up,      forward
///
/// Evaluated in double in exactly this order, without contraction; the bits are the definition.
[[nodiscard]] Ray pixel_ray(const Camera& camera, ImageSize image, int x, int y);

/// Computes many rays faster, from each column's sx and each row's sy.
[[nodiscard]] inline Ray pixel_ray(const Camera& camera, double sx, double sy)
{
    const bool has_eye = camera.projection == Projection::perspective;
    const Vec3d& start = has_eye ? camera.forward : camera.eye;
    const double x = (start.x + sx * camera.right.x) + sy * camera.up.x;
    const double y = (start.y + sx * camera.right.y) + sy * camera.up.y;
    const double z = (start.z + sx * camera.right.z) + sy * camera.up.z;
    if (has_eye) {
        return {camera.eye, {x, y, z}};
    }
    return {{x, y, z}, camera.forward};
}
/// sx of a column and sy of a row, as `pixel_ray` defines them.
[[nodiscard]] double pixel_sx(const Camera& camera, ImageSize image, int x);
[[nodiscard]] double pixel_sy(const Camera& camera, ImageSize image, int y);

/// Distance of the receivers' near plane: 1e-6 × the scene's diagonal [m].
[[nodiscard]] double receiver_near_m(const Box& box);

/// The matrix that draws receivers: reversed depth in [0, 1], near at `receiver_near_m`. A
/// perspective camera has no far plane (depth = near/ζ); an orthographic view ends behind the
/// farthest corner of the box. Composed in double; round once to float32 for GL.
[[nodiscard]] Mat4d camera_clip_from_world(const Camera& camera, ImageSize image, const Box& box);

} // namespace gnomon::scene
