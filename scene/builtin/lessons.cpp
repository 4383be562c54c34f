// The scenes of the lessons that look at a few objects under a spot light.

#include "scene/builtin/scene_list.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>

namespace gnomon::scene {

namespace {

constexpr int ball_slices = 96;
constexpr int ball_stacks = 48;

// --- sphere-cube ---

constexpr double lecture_light_distance_m = 6;

/// From the cube's centre to the light.
[[nodiscard]] Vec3d lecture_light_direction()
{
    return glm::normalize(Vec3d{0.38, 0.62, 0.71});
}

[[nodiscard]] TriangleScene build_sphere_cube(const ParameterValues& values)
{
    SceneBuilder builder;
    add_object(builder, "cube", make_box(Vec3d{-0.8}, Vec3d{0.8}));
    // A little beside the light's axis, so that no pole of the sphere points at the light.
    const Vec3d towards_sphere =
        glm::normalize(lecture_light_direction() + Vec3d{-0.05, 0.03, 0.02});
    add_object(builder, "sphere",
               make_sphere(number(values, "sphere_distance_m") * towards_sphere,
                           number(values, "sphere_radius_m"), ball_slices, ball_stacks));
    return builder.take();
}

[[nodiscard]] Job sphere_cube_job(const ParameterValues& values)
{
    Job job = start_job("sphere-cube", values);
    job.camera =
        CameraSettings{.eye = {4.7, 1.9, 2.5}, .target = {0.3, 0.4, 0.4}, .vertical_fov_deg = 32};
    job.light =
        spot_light(lecture_light_distance_m * lecture_light_direction(), Vec3d{0, 0, 0}, 40);
    job.bias.constant = 0.1;
    return job;
}

// --- sphere-plane ---

[[nodiscard]] TriangleScene build_sphere_plane(const ParameterValues& values)
{
    SceneBuilder builder;
    add_object(builder, "plane", make_ground({-10, -10}, {10, 10}));
    add_object(builder, "sphere",
               make_sphere({2, number(values, "sphere_height_m"), 4}, 1, ball_slices, ball_stacks));
    return builder.take();
}

[[nodiscard]] Job sphere_plane_job(const ParameterValues& values)
{
    Job job = start_job("sphere-plane", values);
    job.camera = CameraSettings{.eye = {6, 5, 7}, .target = {0, 0, 0}, .vertical_fov_deg = 60};
    LightSettings light = spot_light({2.5, 4.8, 4.3}, {2.5, 0, 3.5}, 120);
    if (word(values, "light") == "orthographic") {
        light.type = LightType::directional;
        job.shadow_map.frustum.fit = Fit::fixed;
        job.shadow_map.frustum.half_extent_m = 5;
    }
    job.light = light;
    job.shadow_map.resolution_texels = 512;
    job.shadow_map.frustum.near_m = 0.5;
    job.shadow_map.frustum.far_m = 10;
    job.bias.constant = 0.006;
    return job;
}

// --- two-distances ---

constexpr double nearest_post_m = 4; // in front of the light
constexpr double farthest_post_m = 44;

/// Boxes and balls in turn, on a slalom whose steps grow with the distance.
void add_slalom(SceneBuilder& builder, int object_count)
{
    const double growth =
        std::pow(farthest_post_m / nearest_post_m, 1.0 / static_cast<double>(object_count - 1));
    double distance_m = nearest_post_m;
    for (int i = 0; i < object_count; ++i, distance_m *= growth) {
        const double half_m = 0.14 + 0.016 * distance_m;
        const double side = i % 2 == 0 ? -1.0 : 1.0;
        const Vec3d foot{side * (0.35 + 0.085 * distance_m), 0.0, -distance_m};
        if (i % 4 < 2) {
            Mesh box = make_box({-half_m, -0.1, -half_m}, {half_m, 3 * half_m, half_m});
            turn_about_y(box, 0.35 + 0.6 * i);
            move_by(box, foot);
            add_object(builder, fmt::format("box_{}", i + 1), box);
        } else {
            const double radius_m = 1.4 * half_m;
            const Vec3d centre = foot + Vec3d{0, 1.1 * radius_m, 0};
            add_object(builder, fmt::format("ball_{}", i + 1),
                       make_sphere(centre, radius_m, 48, 24));
        }
    }
}

[[nodiscard]] TriangleScene build_two_distances(const ParameterValues& values)
{
    SceneBuilder builder;
    add_object(builder, "floor", make_ground({-12, -46}, {12, -2.5}));
    add_slalom(builder, count(values, "object_count"));
    return builder.take();
}

[[nodiscard]] Job two_distances_job(const ParameterValues& values)
{
    const Vec3d target{0.4, 0.8, -24};
    Job job = start_job("two-distances", values);
    job.camera = CameraSettings{.eye = {5.0, 6.6, 7}, .target = target, .vertical_fov_deg = 38};
    job.light = spot_light({-2.5, 4.6, 0.5}, target, 80);
    job.shadow_map.depth_format = float_depth_format;
    job.shadow_map.frustum.near_m = 4;
    job.shadow_map.frustum.far_m = 50;
    job.lookup = {Filter::linear, Outside::clamp};
    job.bias.constant = 0.0008;
    return job;
}

} // namespace

BuiltinScene sphere_cube_scene()
{
    return {.name = "sphere-cube",
            .description = "a sphere before a fixed cube under a spot light that looks at them, "
                           "compared with a bias of 0.1 depth units",
            .origin = "lecture on the depth map as a texture: 1024², DEPTH_EPSILON 0.1",
            .parameters = {number_parameter("sphere_radius_m", "radius of the sphere", "m", 0.5,
                                            {0.1, 0.8}),
                           number_parameter("sphere_distance_m",
                                            "from the cube's centre to the sphere's, towards the "
                                            "light",
                                            "m", 1.8, {1.4, 3.0})},
            .build = build_sphere_cube,
            .default_job = sphere_cube_job};
}

BuiltinScene sphere_plane_scene()
{
    return {.name = "sphere-plane",
            .description = "a sphere over a plane of 20 m, near 0.5, far 10, under a spot or an "
                           "orthographic light",
            .origin = "WebGL lesson on shadows: depth texture of 512²",
            .parameters = {word_parameter("light", "the light of the default job",
                                          {"spot", "orthographic"}),
                           number_parameter("sphere_height_m",
                                            "height of the sphere's centre; its "
                                            "radius is 1 m",
                                            "m", 3, {1, 3.2})},
            .build = build_sphere_plane,
            .default_job = sphere_plane_job};
}

BuiltinScene two_distances_scene()
{
    return {.name = "two-distances",
            .description = "boxes and balls spread from 4 to 50 m before a perspective light that "
                           "is aimed as the camera",
            .origin =
                "textbook lesson on shadow maps: near 4, far 50, 32-bit depth, linear filter, "
                "clamp to edge",
            .parameters = {count_parameter("object_count", "boxes and balls on the floor", 12,
                                           {2, 40})},
            .build = build_two_distances,
            .default_job = two_distances_job};
}

} // namespace gnomon::scene
