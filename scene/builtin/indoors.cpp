#include "scene/builtin/scene_list.hpp"

#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>

namespace gnomon::scene {
namespace {

// --- lamp-room ---

/// A box, turned about the vertical axis through its middle.
struct PlacedBox {
    std::string_view object;
    Vec3d middle; ///< of its foot [m]
    Vec3d size;   ///< [m]
    double turn_deg;
};

/// Furniture. No box touches a wall, the floor or another box.
constexpr std::array<PlacedBox, 15> furniture{{
    {"table", {0.5, 0.72, -0.7}, {1.5, 0.05, 0.9}, 12},
    {"table", {-0.05, 0.01, -0.95}, {0.07, 0.7, 0.07}, 12},
    {"table", {0.95, 0.01, -1.2}, {0.07, 0.7, 0.07}, 12},
    {"table", {0.05, 0.01, -0.2}, {0.07, 0.7, 0.07}, 12},
    {"table", {1.05, 0.01, -0.45}, {0.07, 0.7, 0.07}, 12},
    {"book", {0.3, 0.78, -0.6}, {0.24, 0.06, 0.17}, -25},
    {"vase", {0.85, 0.78, -0.85}, {0.12, 0.32, 0.12}, 40},
    {"crate", {-1.7, 0.01, -1.5}, {0.8, 0.6, 0.8}, 20},
    {"crate", {-1.65, 0.62, -1.55}, {0.5, 0.45, 0.5}, -15},
    {"shelf", {2.75, 0.5, 0.4}, {0.3, 0.04, 1.6}, 2},
    {"shelf", {2.75, 1.1, 0.4}, {0.3, 0.04, 1.6}, 2},
    {"shelf", {2.75, 1.7, 0.4}, {0.3, 0.04, 1.6}, 2},
    {"wardrobe", {-2.5, 0.01, 0.9}, {0.6, 2.1, 1.2}, -3},
    {"stool", {1.5, 0.01, 1.3}, {0.4, 0.45, 0.4}, 33},
    {"beam", {-0.3, 2.45, 1.2}, {4.8, 0.15, 0.15}, 4},
}};

constexpr Vec3d lamp_m{0.3, 1.9, 0.2};

/// Turns a point about the y axis, from z towards x.
Vec3d turned(const Vec3d& point, double turn_rad)
{
    Mesh one{{point}, {}};
    turn_about_y(one, turn_rad);
    return one.vertices.front();
}

double turn_of(const ParameterValues& values)
{
    return glm::radians(number(values, "turn_deg"));
}

TriangleScene build_lamp_room(const ParameterValues& values)
{
    const double turn_rad = turn_of(values);
    SceneBuilder builder;
    Mesh walls = make_box({-3, 0, -2.5}, {3, 2.8, 2.5});
    flip(walls);
    turn_about_y(walls, turn_rad);
    add_object(builder, "walls", walls);
    for (std::size_t i = 0; i < furniture.size();) {
        Mesh object;
        const std::string_view name = furniture[i].object;
        for (; i < furniture.size() && furniture[i].object == name; ++i) {
            const PlacedBox& placed = furniture[i];
            const Vec3d half{0.5 * placed.size.x, 0, 0.5 * placed.size.z};
            Mesh box = make_box(-half, half + Vec3d{0, placed.size.y, 0});
            turn_about_y(box, glm::radians(placed.turn_deg));
            move_by(box, placed.middle);
            append(object, box);
        }
        turn_about_y(object, turn_rad);
        add_object(builder, name, object);
    }
    return builder.take();
}

Job lamp_room_job(const ParameterValues& values)
{
    const double turn_rad = turn_of(values);
    Job job = start_job("lamp-room", values);
    job.camera = CameraSettings{.eye = turned({-2.1, 1.7, 2.2}, turn_rad),
                                .target = turned({0.9, 0.9, -0.9}, turn_rad),
                                .vertical_fov_deg = 70};
    LightSettings& light = job.light.emplace();
    light.type = LightType::point;
    light.position = turned(lamp_m, turn_rad);
    job.bias.constant = 0.005;
    return job;
}

} // namespace

BuiltinScene lamp_room_scene()
{
    return {.name = "lamp-room",
            .description = "a closed room of boxes, and a point light in it",
            .origin = "by construction: the same pixels under a cube whose seams lie elsewhere",
            .parameters = {number_parameter("turn_deg",
                                            "turns room, lamp and camera about the vertical, and "
                                            "not the axes that the cube's faces look along",
                                            "deg", 0, {-180, 180})},
            .build = build_lamp_room,
            .default_job = lamp_room_job};
}

} // namespace gnomon::scene
