#include "quadrants.hpp"
#include "methods/key_table.hpp"

#include "scene/geometry/triangles.hpp"

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::tests {
namespace {

void add_quadrangle(scene::SceneBuilder& builder, const std::string& name, const scene::Vec3d& at,
                    const scene::Vec3d& across, const scene::Vec3d& along)
{
    const std::array<scene::Vec3d, 4> corners{at, at + along, at + along + across, at + across};
    constexpr std::array<std::array<std::uint32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
    builder.add(name, corners, triangles);
}

} // namespace

scene::View in_quadrants(scene::View view)
{
    const scene::LightFrustum whole = view.first_map();
    const double middle_x = (whole.left + whole.right_side) / 2;
    const double middle_y = (whole.bottom + whole.top) / 2;
    view.maps.clear();
    for (const bool is_upper : {false, true}) {
        for (const bool is_right : {false, true}) {
            scene::LightFrustum quarter = whole;
            (is_right ? quarter.left : quarter.right_side) = middle_x;
            (is_upper ? quarter.bottom : quarter.top) = middle_y;
            compose_matrix(quarter);
            view.maps.push_back(quarter);
        }
    }
    return view;
}

scene::Texel texel_of_whole(const scene::Texel& texel, int resolution_texels)
{
    return {texel.x + (texel.map % 2) * resolution_texels,
            texel.y + (texel.map / 2) * resolution_texels, 0};
}

scene::SceneFile tilted_quadrangles(std::uint32_t seed)
{
    std::mt19937 random{seed};
    const auto eighths = [&](int from, int to) {
        return std::uniform_int_distribution<int>{from, to}(random) / 8.0;
    };
    const auto power_of_two = [&] {
        return std::ldexp(1, std::uniform_int_distribution{-2, 1}(random));
    };
    scene::SceneBuilder builder;
    std::vector<std::string> casting;
    for (int i = 0; i < 24; ++i) {
        const double side_x = i % 2 == 0 ? -4 : 0;
        const double side_z = i % 4 < 2 ? -4 : 0;
        if (i < 4) {
            add_quadrangle(builder, "ground " + std::to_string(i), {side_x, 0, side_z}, {4, 0, 0},
                           {0, 0, 4});
            continue;
        }
        const double width = power_of_two();
        const double depth = power_of_two();
        const scene::Vec3d at{side_x + eighths(0, 32 - static_cast<int>(8 * width)), eighths(8, 48),
                              side_z + eighths(0, 32 - static_cast<int>(8 * depth))};
        const std::string name = "quadrangle " + std::to_string(i);
        add_quadrangle(builder, name, at, {width, width * eighths(-6, 6), 0},
                       {0, depth * eighths(-6, 6), depth});
        if (i % 3 == 0) {
            casting.push_back(name);
        }
    }
    scene::SceneFile file{builder.take(), {}};
    scene::set_roles(file.scene, {}, casting);
    return file;
}

scene::Job looking_at_quadrangles()
{
    scene::Job job;
    job.keys = methods::key_table();
    job.image = {256, 256};
    const scene::Vec3d eye{3 / 256.0, 11, 5 / 256.0}; // off the centres of texels
    job.camera = scene::CameraSettings{.eye = eye,
                                       .target = eye - scene::Vec3d{0, 1, 0},
                                       .up = {0, 0, 1},
                                       .projection = scene::Projection::orthographic,
                                       .orthographic_height_m = 8};
    job.light = scene::LightSettings{};
    job.light->type = scene::LightType::directional;
    job.light->position = scene::Vec3d{0, 12, 0};
    job.light->target = scene::Vec3d{0, 0, 0};
    job.shadow_map.resolution_texels = 256;
    job.shadow_map.depth_format = {scene::DepthFormat::Kind::d32f, 32};
    job.shadow_map.frustum.fit = scene::Fit::fixed;
    job.shadow_map.frustum.half_extent_m = 4;
    job.shadow_map.frustum.near_m = 0.5;
    job.shadow_map.frustum.far_m = 16.5;
    job.lookup.position = scene::LookupPosition::pixel;
    job.bias.constant = 0.0002;
    return job;
}

scene::Job looking_at_quadrangles_from_aside()
{
    scene::Job job = looking_at_quadrangles();
    job.camera = scene::CameraSettings{.eye = {7, 1, 9}, .target = {0, 3, 0}};
    return job;
}

} // namespace gnomon::tests
