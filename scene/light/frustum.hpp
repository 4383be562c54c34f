#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/depth_range.hpp"
#include "scene/light/light.hpp"
#include "scene/light/map_content.hpp"
#include "scene/vec.hpp"

#include <optional>

namespace gnomon::scene {

enum class Fit : std::uint8_t { scene, camera, fixed };

/// The part of `[shadow_map]` that decides the light's camera.
struct FrustumSettings {
    MapContent content = MapContent::depth;
    Fit fit = Fit::scene;
    double half_extent_m = 20;           ///< fit = fixed, directional; > 0
    std::optional<double> fov_deg;       ///< fit = fixed, spot; (0, 180); default: the cone
    double roll_deg = 0;                 ///< turns the texel grid about the light's axis
    std::optional<double> near_m;        ///< empty: auto
    std::optional<double> far_m;         ///< empty: auto
    bool reversed = false;               ///< near at depth 1, far at 0
    std::optional<ClipRange> clip_range; ///< empty: [0, 1] if reversed, else [−1, 1]
};

/// The clip range that the settings mean.
[[nodiscard]] ClipRange clip_range_of(const FrustumSettings& settings);

/// The light's camera: what the shadow map sees.
struct LightFrustum {
    Projection projection = Projection::orthographic;
    MapContent content = MapContent::depth;
    Vec3d origin;  ///< where the light's camera stands [m]; ζ is measured from its plane
    Vec3d forward; ///< unit
    Vec3d right;   ///< unit, the direction of growing u
    Vec3d up;      ///< unit, the direction of growing v
    /// Sides on the plane ζ = 1 (perspective, tangents) or in metres (orthographic).
    double left = -1;
    double right_side = 1;
    double bottom = -1;
    double top = 1;
    double near_m = 0.1;
    double far_m = 100;
    bool reversed = false;
    ClipRange clip_range = ClipRange::minus_one_to_one;
    /// The map's resolution, a power of two, where its sides are whole texels from the world's
    /// origin, of a width that is a float32: then the matrix's translation along u and v is a
    /// multiple of 2/grid_texels. 0: they are anywhere.
    int grid_texels = 0;
    Mat4d light_clip_from_world_exact{1}; ///< composed in double
    Mat4f light_clip_from_world{1};       ///< rounded once: this one is GL's, and exact input

    /// Eye-space distance ζ of a world point from the light's camera plane [m]; below 0 behind it.
    [[nodiscard]] double light_distance_m(const Vec3d& point) const;
    /// World width of a texel at distance ζ [m]: the larger of the texel's two sides.
    [[nodiscard]] double texel_width_m(double light_distance_m, int resolution_texels) const;
    /// far − near [m]: for orthographic frusta what one depth unit spans along the axis.
    [[nodiscard]] double range_m() const { return far_m - near_m; }
    [[nodiscard]] DepthRange depth_range() const
    {
        return {projection, near_m, far_m, reversed, clip_range};
    }
    /// How what the map stores follows from its content's measure.
    [[nodiscard]] DepthRange stored_range() const
    {
        return traits_of(content).stored_range(depth_range());
    }
    /// The largest measure of points at ζ = 1: of those along rays in a corner of the map.
    [[nodiscard]] double largest_per_light_distance() const;
};

/// Composes both matrices from the other members, in double, and rounds once.
void compose_matrix(LightFrustum& frustum);

} // namespace gnomon::scene
