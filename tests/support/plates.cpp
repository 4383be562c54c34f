#include "plates.hpp"

#include <array>
#include <cstdint>
#include <string>

namespace gnomon::tests {
namespace {

void add(scene::SceneBuilder& builder, const std::string& name, const Plate& plate)
{
    const std::array<scene::Vec3d, 4> corners{
        scene::Vec3d{plate.x0, plate.y, plate.z0}, scene::Vec3d{plate.x0, plate.y, plate.z1},
        scene::Vec3d{plate.x1, plate.y, plate.z1}, scene::Vec3d{plate.x1, plate.y, plate.z0}};
    const std::array<std::array<std::uint32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
    builder.add(name, corners, triangles);
}

} // namespace

scene::SceneFile plates_over_ground(const std::vector<Plate>& plates)
{
    scene::SceneBuilder builder;
    add(builder, "ground", {-4, 4, -4, 4, 0});
    std::vector<std::string> casting;
    for (std::size_t i = 0; i < plates.size(); ++i) {
        casting.push_back("plate " + std::to_string(i));
        add(builder, casting.back(), plates[i]);
    }
    scene::SceneFile file{builder.take(), {}};
    scene::set_roles(file.scene, {}, casting);
    return file;
}

scene::Job looking_down(scene::Job job)
{
    job.image = {128, 128};
    job.camera = scene::CameraSettings{.eye = {0, 8, 0},
                                       .target = {0, 0, 0},
                                       .up = {0, 0, -1},
                                       .projection = scene::Projection::orthographic,
                                       .orthographic_height_m = 8};
    job.light = scene::LightSettings{};
    job.light->type = scene::LightType::directional;
    job.light->position = scene::Vec3d{0, 8, 0};
    job.light->target = scene::Vec3d{0, 0, 0};
    job.shadow_map.resolution_texels = 64;
    job.shadow_map.depth_format = {scene::DepthFormat::Kind::d32f, 32};
    job.shadow_map.frustum = {};
    job.shadow_map.frustum.fit = scene::Fit::fixed;
    job.shadow_map.frustum.half_extent_m = 4;
    job.shadow_map.frustum.near_m = 0.5;
    job.shadow_map.frustum.far_m = 8.5;
    return job;
}

} // namespace gnomon::tests
