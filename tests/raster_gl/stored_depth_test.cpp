#include "gl_case.hpp"

#include "raster_gl/receivers.hpp"
#include "scene/depth/driver_bound.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

/// Compares GL's stored depths at texel centres with the exact depths of the triangles' planes.
///
/// A texel holds the least depth of the triangles that cover its centre. Where coverage is certain
/// a triangle bounds the texel from above, and every triangle that may cover it bounds it from
/// below: stored ∈ [min over possible (z* − B), min over certain (z* + B)], then rounded by the
/// format.
namespace gnomon::raster_gl {
namespace {

using tests::GlCase;

constexpr int resolution_texels = 256;

struct Interval {
    double lower = 1; ///< the cleared map
    double upper = 1;
    bool certain = false; ///< some triangle certainly covers the centre
};

scene::WindowTriangle window_triangle(const std::array<scene::Vec4d, 3>& clip)
{
    scene::WindowTriangle result;
    for (std::size_t k = 0; k < 3; ++k) {
        const scene::Vec3d ndc = scene::Vec3d{clip.at(k)} / clip.at(k).w;
        result.position_px.at(k) = (scene::Vec2d{ndc} * 0.5 + 0.5) * double{resolution_texels};
        result.depth.at(k) = ndc.z * 0.5 + 0.5;
    }
    return result;
}

double cross(const scene::Vec2d& a, const scene::Vec2d& b)
{
    return a.x * b.y - a.y * b.x;
}

/// A triangle in window space, evaluated at texel centres.
class Plane {
public:
    explicit Plane(const scene::WindowTriangle& t)
        : t_{t},
          area2_{cross(t.position_px[1] - t.position_px[0], t.position_px[2] - t.position_px[0])}
    {
    }

    /// Signed distance of a point to the nearest edge [px], positive inside.
    [[nodiscard]] double inside_px(const scene::Vec2d& p) const
    {
        double distance = INFINITY;
        for (std::size_t k = 0; k < 3; ++k) {
            const scene::Vec2d a = t_.position_px.at(k);
            const scene::Vec2d edge = t_.position_px.at((k + 1) % 3) - a;
            distance = std::min(distance, std::copysign(1.0, area2_) * cross(edge, p - a) /
                                              glm::length(edge));
        }
        return distance;
    }
    [[nodiscard]] double depth(const scene::Vec2d& p) const
    {
        const scene::Vec2d d1 = t_.position_px[1] - t_.position_px[0];
        const scene::Vec2d d2 = t_.position_px[2] - t_.position_px[0];
        const scene::Vec2d q = p - t_.position_px[0];
        return t_.depth[0] + (cross(q, d2) * (t_.depth[1] - t_.depth[0]) +
                              cross(d1, q) * (t_.depth[2] - t_.depth[0])) /
                                 area2_;
    }
    [[nodiscard]] bool has_area() const { return area2_ != 0; }

private:
    scene::WindowTriangle t_;
    double area2_;
};

/// Division and viewport of a corner whose clip position is known exactly: quotient, product with
/// 1/w, and ½z + ½, a rounding each, below 1 in magnitude.
constexpr double corner_error = 3 * 0x1p-24;

void include(scene::Image<Interval>& bounds, const scene::WindowTriangle& t, double subpixel_px)
{
    const Plane plane{t};
    if (!plane.has_area()) {
        return;
    }
    const auto [left, right] =
        std::minmax({t.position_px[0].x, t.position_px[1].x, t.position_px[2].x});
    const auto [low, high] =
        std::minmax({t.position_px[0].y, t.position_px[1].y, t.position_px[2].y});
    const auto clamped = [](double v) {
        return std::clamp(static_cast<int>(std::floor(v)), 0, resolution_texels - 1);
    };
    const int row_end = clamped(high + 1);
    const int column_end = clamped(right + 1);
    for (int y = clamped(low - 1); y <= row_end; ++y) {
        for (int x = clamped(left - 1); x <= column_end; ++x) {
            const scene::Vec2d centre{x + 0.5, y + 0.5};
            const double inside_px = plane.inside_px(centre);
            if (inside_px < -subpixel_px) {
                continue;
            }
            const double bound =
                scene::driver_depth_bound(t, tests::raster_model(), corner_error, centre);
            Interval& interval = bounds(x, resolution_texels - 1 - y);
            const double z = plane.depth(centre);
            interval.lower = std::min(interval.lower, z - bound);
            if (inside_px > subpixel_px) {
                interval.upper = std::min(interval.upper, z + bound);
                interval.certain = true;
            }
        }
    }
}

/// Bounds of each texel, or nothing if GL clips a triangle.
std::optional<scene::Image<Interval>> exact_bounds(const GlCase& c)
{
    const auto& context = *tests::shared_context();
    const auto clip =
        capture_clip_positions(context, c.gpu, c.view.first_map().light_clip_from_world);
    const double subpixel_px = std::ldexp(1.0, -context.facts().subpixel_bits);
    scene::Image<Interval> bounds{{resolution_texels, resolution_texels}};
    for (const auto& indices : c.file.scene.triangles) {
        std::array<scene::Vec4d, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners.at(k) = clip.at(indices.at(k));
            if (!(std::abs(corners.at(k).z) <= corners.at(k).w)) {
                return {};
            }
        }
        include(bounds, window_triangle(corners), subpixel_px);
    }
    return bounds;
}

/// Widens an interval of depths to the range that the format may store.
Interval rounded(const Interval& interval, scene::DepthFormat format)
{
    if (format.is_float()) { // nearest float32: half an ulp, at most 2^-25 below 1
        return {interval.lower - 0x1p-25, interval.upper + 0x1p-25, interval.certain};
    }
    const double largest = std::ldexp(1.0, format.bits) - 1;
    return {std::floor(largest * std::max(interval.lower, 0.0)) / largest,
            std::ceil(largest * std::min(interval.upper, 1.0)) / largest, interval.certain};
}

double stored_depth(std::uint32_t code, scene::DepthFormat format)
{
    return format.is_float() ? double{std::bit_cast<float>(code)}
                             : code / (std::ldexp(1.0, format.bits) - 1);
}

/// The map fitted to the scene, with near and far around every vertex: auto planes leave out what
/// is beside the map, and GL clips the triangles that reach there.
void set_map_of_whole_triangles(GlCase& c, const char* format)
{
    std::vector<scene::Override> keys{{"shadow_map.resolution", std::to_string(resolution_texels)},
                                      {"shadow_map.fit", "scene"},
                                      {"shadow_map.near", "\"auto\""},
                                      {"shadow_map.far", "\"auto\""},
                                      {"shadow_map.depth_format", format}};
    c.set(keys);
    double nearest_m = c.view.first_map().near_m;
    double farthest_m = c.view.first_map().far_m;
    for (const scene::Vec3f& vertex : c.file.scene.vertices) {
        const double light_distance_m = c.view.first_map().light_distance_m(scene::Vec3d{vertex});
        nearest_m = std::min(nearest_m, light_distance_m);
        farthest_m = std::max(farthest_m, light_distance_m);
    }
    const double padding_m = 1e-4 * (farthest_m - nearest_m); // float32 errs by less
    keys[2].value = std::to_string(nearest_m - padding_m);
    keys[3].value = std::to_string(farthest_m + padding_m);
    c.set(keys);
}

TEST(StoredDepth, LiesWithinTheDriverBoundOfTheExactPlane)
{
    GNOMON_REQUIRE_GL();
    for (const char* scene : {"yard", "columns", "two-distances", "tilted-plane"}) {
        GlCase c{scene};
        for (const char* format : {"d16", "d24", "d32f"}) {
            set_map_of_whole_triangles(c, format);
            c.draw_shadow_map();
            const auto bounds = exact_bounds(c);
            ASSERT_TRUE(bounds) << scene << ": a triangle is clipped, choose another frustum";
            const auto codes = read_codes(*tests::shared_context(), *c.map);
            std::size_t certain = 0;
            for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
                const Interval allowed = rounded((*bounds)[i], c.map->format);
                const double stored = stored_depth(codes[i], c.map->format);
                ASSERT_GE(stored, allowed.lower) << scene << " " << format << " texel " << i;
                ASSERT_LE(stored, allowed.upper)
                    << scene << " " << format << " texel " << i << " excess "
                    << stored - allowed.upper << " of " << (*bounds)[i].upper - (*bounds)[i].lower;
                certain += allowed.certain ? 1 : 0;
            }
            // Most texels must be bounded from both sides, or the test proves nothing.
            EXPECT_GT(certain, codes.pixel_count() / 4) << scene;
        }
    }
}

} // namespace
} // namespace gnomon::raster_gl
