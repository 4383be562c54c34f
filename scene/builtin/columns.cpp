// A colonnade with stairs and arches. Where parts meet, one is sunk into the other, so that no two
// coplanar faces overlap.

#include "scene/builtin/scene_list.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace gnomon::scene {

namespace {

constexpr double spacing_m = 3;
constexpr double floor_y_m = 0.9;
constexpr double springing_y_m = 4.3; // where the columns carry the arches
constexpr double foot_depth_m = 0.03;
constexpr double front_z_m = 0;
constexpr double back_z_m = -4.2;

/// The stairs, six steps that lead up to the columns' floor from the front, in one solid.
[[nodiscard]] Mesh make_stairs(double half_length_m)
{
    constexpr int step_count = 6;
    constexpr double tread_m = 0.34;
    constexpr double rise_m = floor_y_m / step_count;
    constexpr double floor_front_m = 0.95;
    // In the outline x points away from the viewer: the front lies at −z.
    std::vector<Vec2d> outline{{-back_z_m + 1.1, -0.2}, {-back_z_m + 1.1, floor_y_m}};
    for (int step = step_count; step > 0; --step) {
        const double edge_m = -floor_front_m - tread_m * (step_count - step);
        outline.emplace_back(edge_m, rise_m * step);
        outline.emplace_back(edge_m, step == 1 ? -0.2 : rise_m * (step - 1));
    }
    Mesh stairs = make_prism(outline, -half_length_m, half_length_m);
    turn_quarter(stairs);
    return stairs;
}

/// An arc of the profile, `segments` steps from angle `from` to `to` [turns of a quarter].
void append_arc(std::vector<Vec2d>& profile, const Vec2d& centre, double radius_m, double from,
                double to, int segments)
{
    for (int i = 0; i <= segments; ++i) {
        const double angle_rad =
            std::acos(0.0) * (from + (to - from) * static_cast<double>(i) / segments);
        profile.emplace_back(centre.x + radius_m * std::cos(angle_rad),
                             centre.y + radius_m * std::sin(angle_rad));
    }
}

/// Base, swelling shaft, ring and capital of a column, from below the floor into the arches.
[[nodiscard]] std::vector<Vec2d> column_profile()
{
    const double foot_y_m = floor_y_m - foot_depth_m;
    std::vector<Vec2d> profile{{0, foot_y_m}, {0.47, foot_y_m}, {0.47, floor_y_m + 0.10}};
    append_arc(profile, {0.385, floor_y_m + 0.185}, 0.075, -1, 1, 8); // torus
    constexpr int shaft_segments = 20;
    const double shaft_foot_m = floor_y_m + 0.30;
    const double shaft_top_m = springing_y_m - 0.42;
    for (int i = 0; i <= shaft_segments; ++i) {
        const double t = static_cast<double>(i) / shaft_segments;
        profile.emplace_back(0.34 - 0.06 * t * t, shaft_foot_m + t * (shaft_top_m - shaft_foot_m));
    }
    append_arc(profile, {0.29, springing_y_m - 0.36}, 0.04, -1, 1, 6); // ring
    profile.emplace_back(0.285, springing_y_m - 0.26);
    append_arc(profile, {0.285, springing_y_m - 0.10}, 0.13, -0.8, 0, 6); // echinus
    profile.emplace_back(0.46, springing_y_m - 0.10);
    profile.emplace_back(0.46, springing_y_m + foot_depth_m);
    profile.emplace_back(0.0, springing_y_m + foot_depth_m);
    return profile;
}

void add_columns(SceneBuilder& builder, int column_count, int slices)
{
    const Mesh column = make_revolution(column_profile(), slices);
    for (int i = 0; i < column_count; ++i) {
        const double x = spacing_m * (i - 0.5 * (column_count - 1));
        for (const bool front : {true, false}) {
            Mesh placed = column;
            move_by(placed, {x, 0, front ? front_z_m : back_z_m});
            add_object(builder, fmt::format("{}_column_{}", front ? "front" : "back", i + 1),
                       placed);
        }
    }
}

/// The arcade over the front row, and the beams from there to the lintel over the back row.
void add_top(SceneBuilder& builder, int column_count)
{
    const ArcadeShape shape{.arch_count = column_count - 1,
                            .spacing_m = spacing_m,
                            .arch_radius_m = 1.22,
                            .springing_y_m = springing_y_m,
                            .top_y_m = 6.2,
                            .arch_segments = 32};
    add_object(builder, "arcade",
               make_prism(arcade_outline(shape), front_z_m - 0.27, front_z_m + 0.27));
    const double half_m = 0.5 * spacing_m * (column_count - 1);
    add_object(
        builder, "cornice",
        make_box({-half_m - 0.5, 6.17, front_z_m - 0.42}, {half_m + 0.5, 6.36, front_z_m + 0.42}));
    add_object(builder, "lintel",
               make_box({-half_m - 0.6, springing_y_m, back_z_m - 0.26},
                        {half_m + 0.6, springing_y_m + 0.55, back_z_m + 0.26}));
    for (int i = 0; i < column_count; ++i) {
        const double x = spacing_m * (i - 0.5 * (column_count - 1));
        add_object(builder, fmt::format("beam_{}", i + 1),
                   make_box({x - 0.11, springing_y_m + 0.52, back_z_m - 0.7},
                            {x + 0.11, springing_y_m + 0.80, front_z_m - 0.1}));
    }
    int lath = 0;
    for (const double z : {-1.1, -2.1, -3.1}) {
        add_object(builder, fmt::format("lath_{}", ++lath),
                   make_box({-half_m - 0.4, springing_y_m + 0.77, z - 0.06},
                            {half_m + 0.4, springing_y_m + 0.88, z + 0.06}));
    }
}

/// Two urns on pedestals beside the stairs.
void add_urns(SceneBuilder& builder, double half_length_m, int slices)
{
    constexpr double pedestal_y_m = 1.05;
    std::vector<Vec2d> profile{{0, pedestal_y_m - foot_depth_m},
                               {0.2, pedestal_y_m - foot_depth_m}};
    profile.emplace_back(0.2, pedestal_y_m + 0.05);
    profile.emplace_back(0.08, pedestal_y_m + 0.16);
    append_arc(profile, {0, pedestal_y_m + 0.52}, 0.36, -0.85, 0.55, 16);
    profile.emplace_back(0.3, pedestal_y_m + 0.86);
    profile.emplace_back(0, pedestal_y_m + 0.80);
    const Mesh urn = make_revolution(profile, slices);
    const double x = half_length_m + 0.55;
    constexpr double z = 1.9;
    for (const bool left : {true, false}) {
        const Vec3d foot{left ? -x : x, 0, z};
        const char* side = left ? "left" : "right";
        Mesh pedestal = make_box({-0.34, -0.15, -0.34}, {0.34, pedestal_y_m, 0.34});
        move_by(pedestal, foot);
        add_object(builder, fmt::format("pedestal_{}", side), pedestal);
        Mesh placed = urn;
        move_by(placed, foot);
        add_object(builder, fmt::format("urn_{}", side), placed);
    }
}

[[nodiscard]] TriangleScene build_columns(const ParameterValues& values)
{
    const int column_count = count(values, "column_count");
    const int slices = count(values, "slices");
    const double half_length_m = 0.5 * spacing_m * (column_count - 1) + 1.0;
    SceneBuilder builder;
    add_object(builder, "ground",
               make_ground({-half_length_m - 4, back_z_m - 7}, {half_length_m + 5, 7}));
    add_object(builder, "stairs", make_stairs(half_length_m));
    add_columns(builder, column_count, slices);
    add_top(builder, column_count);
    add_urns(builder, half_length_m, slices);
    return builder.take();
}

[[nodiscard]] Job columns_job(const ParameterValues& values)
{
    Job job = start_job("columns", values);
    job.camera = CameraSettings{
        .eye = {11.5, 3.6, 11.5}, .target = {1.7, 2.7, -1.2}, .vertical_fov_deg = 42};
    job.light = directional_light(Vec3d{0.74, -1, -0.52});
    job.shadow_map.resolution_texels = 2048;
    job.bias.constant_m = 0.03;
    return job;
}

} // namespace

BuiltinScene columns_scene()
{
    return {.name = "columns",
            .description = "a colonnade with stairs, arches and beams, some 100,000 triangles, no "
                           "coplanar overlapping faces",
            .origin = "a scene of architecture: long edges, curved shafts, contact everywhere",
            .parameters = {count_parameter("column_count", "columns in each of the two rows", 8,
                                           {2, 24}),
                           count_parameter("slices", "segments around a column", 64, {8, 256})},
            .build = build_columns,
            .default_job = columns_job};
}

} // namespace gnomon::scene
