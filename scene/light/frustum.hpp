#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace gnomon::scene {

/// The range of z_ndc between near and far: GL's default, or glClipControl(…, GL_ZERO_TO_ONE).
enum class ClipRange : std::uint8_t { minus_one_to_one, zero_to_one };

/// How a projection maps the distance ζ from the camera's plane to depth.
struct DepthRange {
    Projection projection = Projection::perspective;
    double near_m = 0.1;
    double far_m = 100;
    bool reversed = false; ///< near at depth 1, far at 0
    ClipRange clip_range = ClipRange::minus_one_to_one;

    /// far − near [m]: the length of one depth unit in an orthographic projection.
    [[nodiscard]] double range_m() const { return far_m - near_m; }
};

/// The projection's z row as a linear function of ζ: z_clip = x·ζ + y.
///
/// w is ζ for perspective, 1 for orthographic projections.
/// Source: docs/depth_precision.md#depth-of-a-distance.
[[nodiscard]] Vec2d clip_depth_row(const DepthRange& range);

/// What a map stores for the surface nearest to the light.
enum class MapContent : std::uint8_t { depth, distance, linear };

/// The measure of a point that a map stores.
enum class Measure : std::uint8_t {
    clip_depth, ///< z/w by the map's matrix: GL's own depth, reversed or not
    axis,       ///< ζ, the distance from the plane of the light's camera: w
    ray,        ///< ρ, the distance to the light
};

/// Properties of a content. GL writes depth itself. A shader writes the other contents, for
/// positional lights:
///
///     (m − o) / (far − o)        m: the measure, o: near or 0
struct MapContentTraits {
    MapContent content;
    std::string_view name;           ///< in jobs
    std::string_view meaning;        ///< in the description of the key
    std::string_view noun;           ///< in sentences
    std::string_view why_positional; ///< why directional lights do not use it
    std::string_view shader_line;    ///< the value that the shader writes
    Measure measure;
    bool from_near; ///< whether o is near

    [[nodiscard]] bool is_gl_depth() const { return measure == Measure::clip_depth; }
    /// Whether it is the root of a sum of squares, whose means cannot be decided exactly.
    [[nodiscard]] bool is_root() const { return measure == Measure::ray; }
    /// The mapping from the measure to the stored value: linear in [0, 1], except for GL's depth.
    /// @param drawn  the mapping from ζ to GL's depth
    [[nodiscard]] DepthRange stored_range(const DepthRange& drawn) const;
};

/// All contents, in the order of the enumerators.
[[nodiscard]] std::span<const MapContentTraits> map_contents();
[[nodiscard]] const MapContentTraits& traits_of(MapContent content);

[[nodiscard]] std::string_view map_content_name(MapContent content);
/// Empty if no content has that name.
[[nodiscard]] std::optional<MapContent> map_content_from_name(std::string_view name);

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

/// The clip range: given or implied.
[[nodiscard]] ClipRange clip_range_of(const FrustumSettings& settings);

/// The light's camera, which defines a shadow map.
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
    /// The map's resolution, a power of two, if its sides lie on a texel grid through the world's
    /// origin whose spacing is a float32. Then the matrix's translation along u and v is a multiple
    /// of 2/grid_texels. 0: no grid.
    int grid_texels = 0;
    Mat4d light_clip_from_world_exact{1}; ///< composed in double
    Mat4f light_clip_from_world{1};       ///< rounded once: GL's matrix, and exact input

    /// Eye-space distance ζ of a world point from the light's camera plane [m]; below 0 behind it.
    [[nodiscard]] double light_distance_m(const Vec3d& point) const;
    /// World width of a texel at distance ζ [m]: the larger of the texel's two sides.
    [[nodiscard]] double texel_width_m(double light_distance_m, int resolution_texels) const;
    /// far − near [m]: the length of one depth unit of an orthographic frustum.
    [[nodiscard]] double range_m() const { return far_m - near_m; }
    [[nodiscard]] DepthRange depth_range() const
    {
        return {projection, near_m, far_m, reversed, clip_range};
    }
    /// The mapping from the content's measure to the stored value.
    [[nodiscard]] DepthRange stored_range() const
    {
        return traits_of(content).stored_range(depth_range());
    }
    /// The largest measure of points at ζ = 1, found in a corner of the map.
    [[nodiscard]] double largest_per_light_distance() const;
};

/// Composes both matrices from the other members, in double, and rounds once.
void compose_matrix(LightFrustum& frustum);

} // namespace gnomon::scene
