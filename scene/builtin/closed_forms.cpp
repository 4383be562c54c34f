// Scenes whose errors are known in closed form, or by their construction.

#include "scene/builtin/scene_list.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace gnomon::scene {

namespace {

[[nodiscard]] double as_rad(double angle_deg)
{
    return angle_deg * std::numbers::pi / 180;
}

// --- tilted-plane ---

constexpr double plane_half_m = 8;   // along x and z, whatever the tilt
constexpr double map_half_m = 6.5;   // the map lies inside the plane
constexpr double eye_distance_m = 6; // the camera's view lies inside the map

[[nodiscard]] TriangleScene build_tilted_plane(const ParameterValues& values)
{
    const double rise_m = plane_half_m * std::tan(as_rad(number(values, "angle_deg")));
    const double h = plane_half_m;
    SceneBuilder builder;
    add_object(builder, "plane",
               make_quad({-h, rise_m, h}, {h, -rise_m, h}, {h, -rise_m, -h}, {-h, rise_m, -h}));
    return builder.take();
}

[[nodiscard]] Job tilted_plane_job(const ParameterValues& values)
{
    const double angle_rad = as_rad(number(values, "angle_deg"));
    const Vec3d normal{std::sin(angle_rad), std::cos(angle_rad), 0};
    const Vec3d downhill{std::cos(angle_rad), -std::sin(angle_rad), 0};
    const Vec3d across{0, 0, 1};
    Job job = start_job("tilted-plane", values);
    // A little off the normal, so that pixels and texels do not line up.
    const Vec3d target = 0.037 * downhill - 0.053 * across;
    const Vec3d towards_eye = glm::normalize(normal + 0.11 * downhill + 0.17 * across);
    job.camera = CameraSettings{.eye = target + eye_distance_m * towards_eye,
                                .target = target,
                                .up = {0, 0, -1},
                                .vertical_fov_deg = 45};
    job.light = directional_light(Vec3d{0, -1, 0});
    job.shadow_map.depth_format = float_depth_format;
    job.shadow_map.frustum.fit = Fit::fixed;
    job.shadow_map.frustum.half_extent_m = map_half_m;
    return job;
}

// --- wall ---

// The wall reaches below the ground: a foot in the ground's plane would leave the truth there
// undecided.
constexpr double wall_foot_m = 0.1;
constexpr double wall_margin_m = 1; // of ground around the wall and its shadow

[[nodiscard]] Mesh make_wall(double height_m, double width_m, double thickness_m)
{
    const double z = 0.5 * width_m;
    if (thickness_m == 0) {
        return make_quad({0, 0, z}, {0, 0, -z}, {0, height_m, -z}, {0, height_m, z});
    }
    return make_box({-thickness_m, -wall_foot_m, -z}, {0, height_m, z});
}

[[nodiscard]] TriangleScene build_wall(const ParameterValues& values)
{
    const double height_m = number(values, "height_m");
    const double width_m = number(values, "width_m");
    const double thickness_m = number(values, "thickness_m");
    const double shadow_m = height_m * std::tan(as_rad(number(values, "light_angle_deg")));
    const double half_m = 0.5 * width_m + wall_margin_m;
    SceneBuilder builder;
    add_object(
        builder, "ground",
        make_ground({-thickness_m - wall_margin_m, -half_m}, {shadow_m + wall_margin_m, half_m}));
    add_object(builder, "wall", make_wall(height_m, width_m, thickness_m));
    return builder.take();
}

[[nodiscard]] Job wall_job(const ParameterValues& values)
{
    const double angle_rad = as_rad(number(values, "light_angle_deg"));
    Job job = start_job("wall", values);
    job.camera =
        CameraSettings{.eye = {2.3, 1.9, 1.2}, .target = {0.35, 0.12, 0}, .vertical_fov_deg = 45};
    job.light = directional_light(Vec3d{std::sin(angle_rad), -std::cos(angle_rad), 0});
    job.shadow_map.resolution_texels = 4096;
    job.shadow_map.depth_format = float_depth_format;
    job.bias.constant_m = 0.05;
    return job;
}

// --- room ---

[[nodiscard]] TriangleScene build_room(const ParameterValues& values)
{
    const Vec3d lower{-3, 0, -2};
    const Vec3d upper{3, 2.8, 2};
    const Vec3d thickness_m{number(values, "wall_thickness_m")};
    Mesh inner = make_box(lower, upper);
    flip(inner);
    SceneBuilder builder;
    add_object(builder, "outer", make_box(lower - thickness_m, upper + thickness_m));
    add_object(builder, "inner", inner);
    return builder.take();
}

[[nodiscard]] Job room_job(const ParameterValues& values)
{
    Job job = start_job("room", values);
    job.camera =
        CameraSettings{.eye = {-2.5, 1.7, 1.6}, .target = {1.2, 0.9, -0.7}, .vertical_fov_deg = 65};
    job.light = directional_light(Vec3d{0.55, -1, -0.35});
    job.bias.constant_m = 0.02;
    return job;
}

// --- fence ---

constexpr double slat_foot_m = 0.05; // slats hang clear of the ground
constexpr double slat_top_m = 1.25;

[[nodiscard]] Mesh make_slats(int slat_count, double width_m, double spacing_m, double thickness_m)
{
    Mesh slats;
    for (int i = 0; i < slat_count; ++i) {
        const double middle_m = spacing_m * (i - 0.5 * (slat_count - 1));
        const double left_m = middle_m - 0.5 * width_m;
        const double right_m = middle_m + 0.5 * width_m;
        if (thickness_m == 0) {
            append(slats, make_quad({left_m, slat_foot_m, 0}, {right_m, slat_foot_m, 0},
                                    {right_m, slat_top_m, 0}, {left_m, slat_top_m, 0}));
        } else {
            append(slats, make_box({left_m, slat_foot_m, -thickness_m}, {right_m, slat_top_m, 0}));
        }
    }
    return slats;
}

[[nodiscard]] TriangleScene build_fence(const ParameterValues& values)
{
    const int slat_count = count(values, "slat_count");
    const double spacing_m = number(values, "spacing_m");
    const double half_m = 0.5 * spacing_m * slat_count;
    SceneBuilder builder;
    add_object(builder, "ground", make_ground({-half_m - 0.5, -0.6}, {half_m + 1.2, 2.4}));
    add_object(builder, "slats",
               make_slats(slat_count, number(values, "slat_width_m"), spacing_m,
                          number(values, "slat_thickness_m")));
    return builder.take();
}

[[nodiscard]] Job fence_job(const ParameterValues& values)
{
    Job job = start_job("fence", values);
    job.camera =
        CameraSettings{.eye = {1.9, 2.0, 4.1}, .target = {0.2, 0.42, 0.4}, .vertical_fov_deg = 33};
    job.light = directional_light(Vec3d{0.36, -1, 0.93});
    job.bias.constant_m = 0.01;
    return job;
}

} // namespace

BuiltinScene tilted_plane_scene()
{
    return {.name = "tilted-plane",
            .description = "one plane at a given angle to a light that shines straight down, wider "
                           "than map and view",
            .origin = "closed form: acne ends at a bias of half a texel times tan(angle)",
            .parameters = {number_parameter("angle_deg", "between the plane's normal and the light",
                                            "deg", 45, {0, 89})},
            .build = build_tilted_plane,
            .default_job = tilted_plane_job};
}

BuiltinScene wall_scene()
{
    return {.name = "wall",
            .description = "an upright sheet or slab on flat ground, lit across; its face of "
                           "shadow is at x = 0",
            .origin = "closed form: a bias of b metres detaches the shadow by b·sin(light angle)",
            .parameters = {number_parameter("thickness_m", "0 is a sheet of two triangles", "m", 0,
                                            {0, 2}),
                           number_parameter("height_m", "height above ground", "m", 2, {0.1, 10}),
                           number_parameter("width_m", "width along z", "m", 4, {0.1, 20}),
                           number_parameter("light_angle_deg", "between the light and the vertical",
                                            "deg", 45, {1, 80})},
            .build = build_wall,
            .default_job = wall_job};
}

BuiltinScene room_scene()
{
    return {.name = "room",
            .description = "a closed room seen from inside, the sun outside: everything there is "
                           "blocked",
            .origin = "by construction: every lit pixel is a leak",
            .parameters = {number_parameter(
                "wall_thickness_m", "thickness of walls, floor and ceiling", "m", 0.2, {0.001, 2})},
            .build = build_room,
            .default_job = room_job};
}

BuiltinScene fence_scene()
{
    return {
        .name = "fence",
        .description = "upright slats that cast on ground: occluders above, at and below the "
                       "size of a texel",
        .origin = "by construction: the slats' width against the texel's",
        .parameters = {number_parameter("slat_width_m", "width of a slat", "m", 0.04,
                                        {0.0005, 0.1}),
                       number_parameter("spacing_m", "from centre to centre", "m", 0.12, {0.11, 1}),
                       count_parameter("slat_count", "number of slats", 30, {1, 1000}),
                       number_parameter("slat_thickness_m", "0 is a sheet", "m", 0.01, {0, 0.1})},
        .build = build_fence,
        .default_job = fence_job};
}

} // namespace gnomon::scene
