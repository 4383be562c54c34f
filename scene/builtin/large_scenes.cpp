// Large scenes: a height field, and a field of spheres.

#include "scene/builtin/scene_list.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace gnomon::scene {

namespace {

// --- terrain ---

constexpr double terrain_side_m = 40;

/// One wave of the rolling ground.
struct Wave {
    Vec2d turns_per_m;
    double phase_rad = 0;
    double amplitude_m = 0;
};

constexpr std::size_t wave_count = 14;

/// Waves in random directions, each shorter and lower than the one before.
[[nodiscard]] std::array<Wave, wave_count> make_waves(int seed, double relief_m)
{
    // The standard fixes the engine's numbers, but not those of its distributions.
    std::mt19937 engine{static_cast<std::uint32_t>(seed)};
    const auto uniform_turn = [&engine] { return static_cast<double>(engine()) / 0x1p32; };
    std::array<Wave, wave_count> waves;
    double frequency = 1.1 / terrain_side_m;
    double weight = 1;
    double weight_sum = 0;
    for (Wave& wave : waves) {
        const double heading_rad = 2 * std::numbers::pi * uniform_turn();
        wave.turns_per_m = frequency * Vec2d{std::cos(heading_rad), std::sin(heading_rad)};
        wave.phase_rad = 2 * std::numbers::pi * uniform_turn();
        wave.amplitude_m = weight;
        weight_sum += weight;
        frequency *= 1.27;
        weight *= 0.74;
    }
    for (Wave& wave : waves) {
        wave.amplitude_m *= relief_m / weight_sum;
    }
    return waves;
}

[[nodiscard]] double height_m(const std::array<Wave, wave_count>& waves, const Vec2d& position)
{
    double sum_m = 0;
    for (const Wave& wave : waves) {
        const double turns = wave.turns_per_m.x * position.x + wave.turns_per_m.y * position.y;
        sum_m += wave.amplitude_m * std::sin(2 * std::numbers::pi * turns + wave.phase_rad);
    }
    return sum_m;
}

[[nodiscard]] TriangleScene build_terrain(const ParameterValues& values)
{
    const auto cells = static_cast<std::uint32_t>(count(values, "cells"));
    const auto waves = make_waves(count(values, "seed"), number(values, "relief_m"));
    Mesh mesh;
    for (std::uint32_t row = 0; row <= cells; ++row) {
        for (std::uint32_t column = 0; column <= cells; ++column) {
            const double x = terrain_side_m * (column / static_cast<double>(cells) - 0.5);
            const double z = terrain_side_m * (row / static_cast<double>(cells) - 0.5);
            mesh.vertices.emplace_back(x, height_m(waves, {x, z}), z);
        }
    }
    for (std::uint32_t row = 0; row < cells; ++row) {
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t back_left = row * (cells + 1) + column;
            const std::uint32_t front_left = back_left + cells + 1;
            mesh.triangles.push_back({back_left, front_left, front_left + 1});
            mesh.triangles.push_back({back_left, front_left + 1, back_left + 1});
        }
    }
    SceneBuilder builder;
    add_object(builder, "terrain", mesh);
    return builder.take();
}

[[nodiscard]] Job terrain_job(const ParameterValues& values)
{
    Job job = start_job("terrain", values);
    job.camera = CameraSettings{.eye = {9, 18, 29}, .target = {0, -1, 1}, .vertical_fov_deg = 38};
    job.light = directional_light(sunlight_direction(number(values, "sun_elevation_deg"), -68));
    job.shadow_map.resolution_texels = 2048;
    job.bias.constant_m = 0.06;
    return job;
}

// --- sphere-field ---

constexpr int spheres_per_side = 8;
constexpr double sphere_spacing_m = 1.5;

[[nodiscard]] TriangleScene build_sphere_field(const ParameterValues&)
{
    SceneBuilder builder;
    add_object(builder, "ground", make_ground({-7.5, -7.5}, {7.5, 7.5}));
    for (int i = 0; i < spheres_per_side * spheres_per_side; ++i) {
        const int row = i / spheres_per_side;
        const int column = i % spheres_per_side;
        // The spheres differ a little in size and hover just above the ground.
        const double radius_m = 0.40 + 0.03 * ((3 * row + 5 * column) % 8);
        const double middle = 0.5 * (spheres_per_side - 1);
        const Vec3d centre{sphere_spacing_m * (column - middle), radius_m + 0.02,
                           sphere_spacing_m * (row - middle)};
        add_object(builder, fmt::format("sphere_{}", i + 1),
                   make_sphere(centre, radius_m, 128, 65));
    }
    return builder.take();
}

[[nodiscard]] Job sphere_field_job(const ParameterValues& values)
{
    Job job = start_job("sphere-field", values);
    job.image = {1920, 1080};
    job.camera =
        CameraSettings{.eye = {3.4, 7.8, 12.2}, .target = {0.1, 0, -0.3}, .vertical_fov_deg = 40};
    job.light = directional_light(Vec3d{-0.62, -1, -0.37});
    job.shadow_map.resolution_texels = 2048;
    job.bias.constant_m = 0.02;
    return job;
}

} // namespace

BuiltinScene terrain_scene()
{
    return {
        .name = "terrain",
        .description = "a rolling height field of 40 m under a low sun: grazing light",
        .origin = "by construction: the slope of the light against that of the ground",
        .parameters = {count_parameter("cells", "cells along a side", 256, {8, 1024}),
                       number_parameter("relief_m", "highest possible rise above the mean", "m", 4,
                                        {0, 10}),
                       count_parameter("seed", "chooses the hills", 7, {0, 1e6}),
                       number_parameter("sun_elevation_deg", "height of the sun above the horizon",
                                        "deg", 12, {1, 85})},
        .build = build_terrain,
        .default_job = terrain_job};
}

BuiltinScene sphere_field_scene()
{
    return {.name = "sphere-field",
            .description = "1,048,578 triangles: 64 spheres of 16,384 over ground of 2",
            .origin = "a scene for measuring speed: 1920×1080 pixels, 2048² map",
            .parameters = {},
            .build = build_sphere_field,
            .default_job = sphere_field_job};
}

} // namespace gnomon::scene
