// The scenes of the lessons that stand outdoors, under the sun.

#include "scene/builtin/scene_list.hpp"

#include <fmt/format.h>

#include <array>

namespace gnomon::scene {

namespace {

// Solids on the ground reach below it: a foot in the ground's plane would leave the truth there
// undecided.
constexpr double sunk_m = 0.1;

// --- yard ---

void add_house(SceneBuilder& builder)
{
    const std::array<Vec2d, 7> outline{Vec2d{-3, -sunk_m}, Vec2d{3, -sunk_m}, Vec2d{3, 2.8},
                                       Vec2d{3.5, 2.8},    Vec2d{0, 5.2},     Vec2d{-3.5, 2.8},
                                       Vec2d{-3, 2.8}};
    Mesh house = make_prism(outline, -4, 4);
    turn_about_y(house, 0.3);
    move_by(house, {-4, 0, -4});
    add_object(builder, "house", house);

    Mesh chimney = make_box({1.2, 3.6, 0.9}, {1.9, 6.0, 1.6});
    turn_about_y(chimney, 0.3);
    move_by(chimney, {-4, 0, -4});
    add_object(builder, "chimney", chimney);
}

void add_trees(SceneBuilder& builder)
{
    const std::array<Vec3d, 5> feet{Vec3d{5.5, 0, -6.2}, Vec3d{9.1, 0, -2.3}, Vec3d{-10.8, 0, 2.7},
                                    Vec3d{-12.3, 0, -7.4}, Vec3d{6.9, 0, 3.1}};
    for (std::size_t i = 0; i < feet.size(); ++i) {
        const double scale = 0.8 + 0.13 * static_cast<double>(i);
        add_object(builder, fmt::format("trunk_{}", i + 1),
                   make_cylinder(feet[i] - Vec3d{0, sunk_m, 0}, 0.22 * scale, 2.1 * scale, 24));
        const Vec3d crown = feet[i] + Vec3d{0, 3.1 * scale, 0};
        add_object(builder, fmt::format("crown_{}", i + 1),
                   make_sphere(crown, 1.4 * scale, 48, 24));
    }
}

void add_crates(SceneBuilder& builder)
{
    const std::array<Vec3d, 4> feet{Vec3d{2.2, 0, 3.1}, Vec3d{3.9, 0, 2.3}, Vec3d{3.0, 0, 5.2},
                                    Vec3d{-1.7, 0, 4.4}};
    for (std::size_t i = 0; i < feet.size(); ++i) {
        const double half_m = 0.45 + 0.08 * static_cast<double>(i);
        Mesh crate = make_box({-half_m, -sunk_m, -half_m}, {half_m, 1.7 * half_m, half_m});
        turn_about_y(crate, 0.4 + 0.9 * static_cast<double>(i));
        move_by(crate, feet[i]);
        add_object(builder, fmt::format("crate_{}", i + 1), crate);
    }
    add_object(builder, "barrel", make_cylinder({0.4, -sunk_m, 2.6}, 0.42, 1.15, 48));
    add_object(builder, "ball", make_sphere({1.1, 0.37, 5.6}, 0.35, 64, 32));
}

[[nodiscard]] TriangleScene build_yard(const ParameterValues&)
{
    SceneBuilder builder;
    add_object(builder, "ground", make_ground({-26, -26}, {26, 26}));
    add_house(builder);
    add_trees(builder);
    add_crates(builder);
    return builder.take();
}

[[nodiscard]] Job yard_job(const ParameterValues& values)
{
    Job job = start_job("yard", values);
    job.camera = CameraSettings{
        .eye = {9.5, 8.5, 17.5}, .target = {-0.8, 0.7, -0.6}, .vertical_fov_deg = 40};
    // The light's camera stands 50 m from the yard, in the middle between near and far.
    const double light_distance_m = 50;
    LightSettings light;
    light.position = -light_distance_m * sunlight_direction(number(values, "sun_elevation_deg"),
                                                            number(values, "sun_azimuth_deg"));
    light.target = Vec3d{0, 0, 0};
    job.light = light;
    job.shadow_map.depth_format = float_depth_format;
    job.shadow_map.frustum.fit = Fit::fixed;
    job.shadow_map.frustum.half_extent_m = 20;
    job.shadow_map.frustum.near_m = 0.01;
    job.shadow_map.frustum.far_m = 100;
    job.lookup = {Filter::pcf3, Outside::lit};
    job.bias.constant = 0.0006;
    return job;
}

// --- playground ---

void add_slide(SceneBuilder& builder)
{
    const std::array<Vec2d, 8> outline{
        Vec2d{-2.6, -sunk_m}, Vec2d{-2.3, -sunk_m}, Vec2d{0.35, 1.75}, Vec2d{1.25, 1.75},
        Vec2d{1.25, 1.9},     Vec2d{0.3, 1.9},      Vec2d{-2.2, 0.25}, Vec2d{-2.6, 0.25}};
    const auto place = [&builder](const char* name, Mesh part) {
        turn_about_y(part, -0.45);
        move_by(part, {-2.2, 0, -1.4});
        add_object(builder, name, part);
    };
    place("slide", make_prism(outline, -0.4, 0.4));
    place("slide_rail_left", make_box({0.3, 1.85, 0.28}, {1.15, 2.35, 0.34}));
    place("slide_rail_right", make_box({0.3, 1.85, -0.34}, {1.15, 2.35, -0.28}));
    int leg = 0;
    for (const double x : {0.5, 1.1}) {
        for (const double z : {-0.25, 0.25}) {
            const std::string name = fmt::format("slide_leg_{}", ++leg);
            place(name.c_str(), make_cylinder({x, -sunk_m, z}, 0.05, 1.9, 24));
        }
    }
}

void add_swing(SceneBuilder& builder)
{
    const auto place = [&builder](const char* name, Mesh part) {
        turn_about_y(part, 0.2);
        move_by(part, {3.0, 0, -1.9});
        add_object(builder, name, part);
    };
    place("swing_post_left", make_cylinder({-1.3, -sunk_m, 0}, 0.07, 2.5, 24));
    place("swing_post_right", make_cylinder({1.3, -sunk_m, 0}, 0.07, 2.5, 24));
    place("swing_beam", make_box({-1.5, 2.25, -0.05}, {1.5, 2.36, 0.06}));
    place("swing_seat", make_box({-0.28, 0.52, -0.16}, {0.28, 0.57, 0.16}));
    place("swing_rope_left", make_box({-0.23, 0.55, -0.012}, {-0.206, 2.27, 0.012}));
    place("swing_rope_right", make_box({0.206, 0.55, -0.012}, {0.23, 2.27, 0.012}));
}

void add_toys(SceneBuilder& builder)
{
    const std::array<Vec3d, 3> balls{Vec3d{0.9, 0.33, 1.9}, Vec3d{-0.5, 0.26, 2.6},
                                     Vec3d{2.6, 0.41, 1.1}};
    for (std::size_t i = 0; i < balls.size(); ++i) {
        add_object(builder, fmt::format("ball_{}", i + 1),
                   make_sphere(balls[i], balls[i].y - 0.01, 64, 32));
    }
    const std::array<Vec3d, 3> boxes{Vec3d{-3.4, 0.45, 1.5}, Vec3d{-3.36, 1.15, 1.46},
                                     Vec3d{-2.1, 0.35, 2.2}};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double half_m = i == 1 ? 0.28 : boxes[i].y;
        // The upper box is sunk into the lower one, the others into the ground.
        Mesh box = make_box({-half_m, -half_m - 0.03, -half_m}, Vec3d{half_m});
        turn_about_y(box, 0.5 + 0.8 * static_cast<double>(i));
        move_by(box, boxes[i]);
        add_object(builder, fmt::format("box_{}", i + 1), box);
    }
}

[[nodiscard]] TriangleScene build_playground(const ParameterValues&)
{
    SceneBuilder builder;
    add_object(builder, "ground", make_ground({-7, -6}, {7, 6}));
    add_slide(builder);
    add_swing(builder);
    add_toys(builder);
    return builder.take();
}

[[nodiscard]] Job playground_job(const ParameterValues& values)
{
    Job job = start_job("playground", values);
    job.camera =
        CameraSettings{.eye = {3.6, 4.3, 8.0}, .target = {0.1, 0.75, -0.2}, .vertical_fov_deg = 37};
    job.light = directional_light(
        sunlight_direction(number(values, "sun_elevation_deg"), number(values, "sun_azimuth_deg")));
    job.bias.constant_m = 0.03;
    return job;
}

[[nodiscard]] std::vector<BuiltinParameter> sun_parameters(double elevation_deg, double azimuth_deg)
{
    return {number_parameter("sun_elevation_deg", "height of the sun above the horizon", "deg",
                             elevation_deg, {5, 85}),
            number_parameter("sun_azimuth_deg", "where the sun stands, from +z towards +x", "deg",
                             azimuth_deg, {-180, 180})};
}

} // namespace

BuiltinScene yard_scene()
{
    return {.name = "yard",
            .description = "a house, trees and crates on ground that is larger than the map",
            .origin = "OpenGL course notes: orthographic ±20, near 0.01, far 100, float depth, "
                      "PCF 3×3",
            .parameters = sun_parameters(48, -37),
            .build = build_yard,
            .default_job = yard_job};
}

BuiltinScene playground_scene()
{
    return {.name = "playground",
            .description = "a slide, a swing, boxes and balls under the sun; the map's box is "
                           "fitted to all vertices",
            .origin = "game developer's note: orthographic sun, near = −z_max, far = −z_min",
            .parameters = sun_parameters(50, -50),
            .build = build_playground,
            .default_job = playground_job};
}

} // namespace gnomon::scene
