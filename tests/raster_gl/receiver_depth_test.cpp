#include "gl_case.hpp"

#include "raster_gl/receivers.hpp"
#include "scene/depth/driver_bound.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

/// r, the depth that the lookup computed for a receiver, against the exact depth of
/// P = pixel-centre ray ∩ plane(T) under the float32 light matrix.
///
/// Four errors add up. Camera vertices are transformed in float32, so the surface point that GL
/// shows at a pixel centre lies up to `shift` pixels beside it: r is compared with the range of the
/// exact depth over that neighbourhood. Light clip coordinates are transformed in float32 too
/// (`transform`). Each coordinate c is interpolated as (c/w)/(1/w), two planes with the driver
/// bound (`interpolation`). Division, ½z + ½ round at last.
namespace gnomon::raster_gl {
namespace {

using tests::GlCase;

constexpr double u32 = 0x1p-24;
constexpr double gamma4 = 4 * u32 / (1 - 4 * u32);

struct TriangleFacts {
    std::array<scene::Vec2d, 3> window_px;
    std::array<double, 3> camera_w;
    std::array<scene::Vec4d, 3> light_clip; ///< as GL computed it
    double camera_error = 0;                ///< of x and w in clip units
    scene::Vec2d light_error{};             ///< of z and w in clip units
};

/// Largest γ4·S of some rows of a matrix over the corners.
double row_error(const scene::Mat4f& matrix, const std::array<scene::Vec3f, 3>& corners, int row)
{
    double largest = 0;
    for (const scene::Vec3f& corner : corners) {
        const scene::Vec4d p{scene::Vec3d{corner}, 1};
        double sum = 0;
        for (int column = 0; column < 4; ++column) {
            sum += std::abs(double{matrix[column][row]} * p[column]);
        }
        largest = std::max(largest, gamma4 * sum);
    }
    return largest;
}

class Model {
public:
    explicit Model(const GlCase& c)
        : c_{c},
          camera_{
              scene::camera_clip_from_world(c.view.camera, c.view.image, c.file.scene.bounds())},
          camera_clip_{capture_clip_positions(*tests::shared_context(), c.gpu, camera_)},
          light_clip_{capture_clip_positions(*tests::shared_context(), c.gpu,
                                             c.view.first_map().light_clip_from_world)}
    {
    }

    [[nodiscard]] TriangleFacts facts(std::uint32_t triangle) const
    {
        TriangleFacts result;
        const auto& indices = c_.file.scene.triangles.at(triangle);
        const auto corners = c_.file.scene.corners(triangle);
        const scene::Vec2d size{c_.view.image.width_px, c_.view.image.height_px};
        for (std::size_t k = 0; k < 3; ++k) {
            const scene::Vec4d clip{camera_clip_.at(indices.at(k))};
            result.camera_w.at(k) = clip.w;
            result.window_px.at(k) = (scene::Vec2d{clip} / clip.w * 0.5 + 0.5) * size;
            result.light_clip.at(k) = light_clip_.at(indices.at(k));
        }
        for (const int row : {0, 1, 3}) {
            result.camera_error = std::max(result.camera_error, row_error(camera_, corners, row));
        }
        const scene::Mat4f& light = c_.view.first_map().light_clip_from_world;
        result.light_error = {row_error(light, corners, 2), row_error(light, corners, 3)};
        return result;
    }

    /// Light clip coordinates of the point where the ray through (x, y), in pixels from the top
    /// left, meets the triangle's plane.
    [[nodiscard]] scene::Vec4d light_clip_at(std::uint32_t triangle, double x, double y) const
    {
        return scene::Mat4d{c_.view.first_map().light_clip_from_world} *
               scene::Vec4d{point_at(triangle, x, y), 1};
    }
    /// Distance of that point from the camera's plane [m].
    [[nodiscard]] double camera_w_at(std::uint32_t triangle, double x, double y) const
    {
        return glm::dot(c_.view.camera.forward, point_at(triangle, x, y) - c_.view.camera.eye);
    }

private:
    [[nodiscard]] scene::Vec3d point_at(std::uint32_t triangle, double x, double y) const
    {
        const auto corners = c_.file.scene.corners(triangle);
        const scene::Vec3d a{corners[0]};
        const scene::Vec3d n =
            glm::cross(scene::Vec3d{corners[1]} - a, scene::Vec3d{corners[2]} - a);
        const scene::Camera& camera = c_.view.camera;
        const double aspect = double(c_.view.image.width_px) / c_.view.image.height_px;
        const double sx = (2 * x / c_.view.image.width_px - 1) * aspect * camera.half_height;
        const double sy = (1 - 2 * y / c_.view.image.height_px) * camera.half_height;
        const scene::Vec3d d = camera.forward + sx * camera.right + sy * camera.up;
        return camera.eye + glm::dot(n, a - camera.eye) / glm::dot(n, d) * d;
    }

    const GlCase& c_;
    scene::Mat4f camera_;
    std::vector<scene::Vec4f> camera_clip_;
    std::vector<scene::Vec4f> light_clip_;
};

/// Bound of a coordinate that is interpolated perspectively, at a pixel whose own w is `pixel_w`.
double interpolation_bound(const TriangleFacts& t, const std::array<double, 3>& values,
                           double value, double pixel_w, const scene::Vec2d& centre_px)
{
    scene::WindowTriangle over_w{t.window_px, {}};
    scene::WindowTriangle one_over_w{t.window_px, {}};
    double largest_over_w = 0;
    double largest_one_over_w = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        one_over_w.depth.at(k) = 1 / t.camera_w.at(k);
        over_w.depth.at(k) = values.at(k) / t.camera_w.at(k);
        largest_over_w = std::max(largest_over_w, std::abs(over_w.depth.at(k)));
        largest_one_over_w = std::max(largest_one_over_w, one_over_w.depth.at(k));
    }
    const scene::RasterModel model = tests::raster_model();
    // 2·u32: reciprocal and product at each corner.
    const double a = scene::driver_depth_bound(over_w, model, 2 * u32 * largest_over_w, centre_px);
    const double b =
        scene::driver_depth_bound(one_over_w, model, 2 * u32 * largest_one_over_w, centre_px);
    // Quotient at the pixel; 4·u32: reciprocal and product there, and second-order terms.
    return (a + std::abs(value) * b) * pixel_w + 4 * u32 * std::abs(value);
}

struct Check {
    std::size_t checked = 0;
    std::size_t skipped = 0;  ///< slivers: the centre's weights cannot bound anything
    double largest_share = 0; ///< of the bound
};

/// Checks one pixel; `r` is GL's.
void check_pixel(const Model& model, const TriangleFacts& t, std::uint32_t triangle, int x, int y,
                 int height_px, float r, Check& check)
{
    const scene::Vec4d clip = model.light_clip_at(triangle, x + 0.5, y + 0.5);
    const double z_ndc = clip.z / clip.w;
    const double exact = z_ndc * 0.5 + 0.5;
    if (!(*std::min_element(t.camera_w.begin(), t.camera_w.end()) > 0) || !(clip.w > 0)) {
        ++check.skipped;
        return;
    }
    const double pixel_w = model.camera_w_at(triangle, x + 0.5, y + 0.5);
    const scene::Vec2d centre_px{x + 0.5, height_px - y - 0.5};
    std::array<double, 3> z{};
    std::array<double, 3> w{};
    for (std::size_t k = 0; k < 3; ++k) {
        z.at(k) = t.light_clip.at(k).z;
        w.at(k) = t.light_clip.at(k).w;
    }
    const double z_error = t.light_error.x + interpolation_bound(t, z, clip.z, pixel_w, centre_px);
    const double w_error = t.light_error.y + interpolation_bound(t, w, clip.w, pixel_w, centre_px);
    const double shift_px = 2 * t.camera_error / pixel_w * height_px + 8 * u32 * height_px;
    double low = exact;
    double high = exact;
    for (const double dx : {-shift_px, shift_px}) {
        for (const double dy : {-shift_px, shift_px}) {
            const scene::Vec4d beside = model.light_clip_at(triangle, x + 0.5 + dx, y + 0.5 + dy);
            low = std::min(low, beside.z / beside.w * 0.5 + 0.5);
            high = std::max(high, beside.z / beside.w * 0.5 + 0.5);
        }
    }
    const double bound = 0.5 * (z_error + std::abs(z_ndc) * w_error) / clip.w + 3 * u32;
    ASSERT_GE(r, low - bound) << "pixel " << x << ", " << y << " triangle " << triangle;
    ASSERT_LE(r, high + bound) << "pixel " << x << ", " << y << " triangle " << triangle;
    ++check.checked;
    check.largest_share =
        std::max(check.largest_share, std::abs(double{r} - exact) / (bound + (high - low)));
}

TEST(ReceiverDepth, LiesWithinItsBoundOfTheExactDepthOfP)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"sphere-cube", "columns", "two-distances", "tilted-plane"}) {
        GlCase c{scene, {{"image.width", "480"}, {"image.height", "270"}}};
        c.draw_all();
        const auto triangles = read_triangles(*tests::shared_context(), *c.receivers);
        const auto samples = c.lookup_pass.read().samples;
        const Model model{c};
        Check check;
        for (int y = 0; y < 270; ++y) {
            for (int x = 0; x < 480; ++x) {
                const std::uint32_t t = triangles(x, y);
                if (t != scene::no_triangle) {
                    check_pixel(model, model.facts(t), t, x, y, 270, samples(x, y).receiver_depth,
                                check);
                    ASSERT_FALSE(HasFatalFailure()) << scene;
                }
            }
        }
        EXPECT_GT(check.checked, 20000U) << scene;
        EXPECT_LT(check.skipped, check.checked / 4) << scene;
        RecordProperty(std::string{scene} + "_largest_share", std::to_string(check.largest_share));
    }
}

} // namespace
} // namespace gnomon::raster_gl
