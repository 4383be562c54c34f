#include "cli/renderer/protocol/frame_case.hpp"

#include "scene/job/toml.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gnomon::cli {
namespace {

std::string toml_value(const AnswerJson& value, const std::string& name)
{
    if (value.is_string()) {
        return scene::toml_quoted(value.get<std::string>());
    }
    if (value.is_boolean() || value.is_number_integer()) {
        return value.dump();
    }
    if (value.is_number() && std::isfinite(value.get<double>())) {
        return scene::toml_number(value.get<double>());
    }
    if (!value.is_array()) {
        throw BadAnswer(fmt::format("{} is {}; no case.toml can say that", said_excerpt(name),
                                    answer_excerpt(value)));
    }
    std::string list;
    for (const AnswerJson& item : value) {
        list += fmt::format("{}{}", list.empty() ? "" : ", ", toml_value(item, name));
    }
    return fmt::format("[{}]", list);
}

/// A table as lines, those of tables in it by dotted keys.
std::string toml_lines(const AnswerJson& table, const std::string& prefix, const std::string& name)
{
    std::string text;
    for (const auto& [key, value] : table.items()) {
        const std::string quoted = prefix + scene::toml_quoted(key);
        const std::string full = fmt::format("{}.{}", name, key);
        text += value.is_object() ? toml_lines(value, quoted + ".", full)
                                  : fmt::format("{} = {}\n", quoted, toml_value(value, full));
    }
    return text;
}

AnswerJson vector_in(const scene::CaseSpace& space, const scene::Vec3d& point)
{
    const scene::Vec3d moved = space.from_mesh(point);
    return {moved.x, moved.y, moved.z};
}

/// The way of a direction in the renderer's axes, of the same length.
AnswerJson direction_in(scene::CaseSpace space, const scene::Vec3d& direction)
{
    space.units_per_mesh_unit = 1;
    return vector_in(space, direction);
}

AnswerJson camera_table(const scene::CameraSettings& camera, const scene::CaseSpace& space)
{
    AnswerJson table{{"eye", vector_in(space, camera.eye)},
                     {"target", vector_in(space, camera.target)},
                     {"up", direction_in(space, camera.up)}};
    if (camera.projection == scene::Projection::perspective) {
        table["vertical_fov_deg"] = camera.vertical_fov_deg;
    } else {
        table["orthographic_height"] = camera.orthographic_height_m * space.units_per_mesh_unit;
    }
    return table;
}

AnswerJson light_table(const scene::LightSettings& light, const scene::CaseSpace& space)
{
    AnswerJson table{{"type", scene::light_type_name(light.type)}};
    if (light.direction) {
        table["direction"] = direction_in(space, *light.direction);
    }
    if (light.position) {
        table["position"] = vector_in(space, *light.position);
    }
    if (light.target) {
        table["target"] = vector_in(space, *light.target);
    }
    if (scene::has_cone(light.type)) {
        table["cone_deg"] = light.cone_deg;
    }
    return table;
}

/// What the renderer was told to do, and says that it did in place of it.
AnswerJson settings_tables(const RendererDraw& draw, const DrawnAnswer& drawn,
                           const scene::CaseSpace& space)
{
    AnswerJson tables = given_tables(draw);
    tables.erase("method");
    tables["shadow_map"]["resolution"] = draw.job.shadow_map.resolution_texels;
    if (draw.view.maps.size() == 1) {
        const scene::LightFrustum& map = draw.view.first_map();
        tables["shadow_map"]["near"] = map.near_m * space.units_per_mesh_unit;
        tables["shadow_map"]["far"] = map.far_m * space.units_per_mesh_unit;
    }
    for (const auto& [name, table] : drawn.tables.items()) {
        tables[name].update(table);
    }
    return tables;
}

} // namespace

std::string toml_table(std::string_view name, const AnswerJson& table)
{
    return table.empty() ? std::string{}
                         : fmt::format("\n[{}]\n{}", name,
                                       toml_lines(table, "", fmt::format("case.{}", name)));
}

std::string frame_case(const RendererHello& hello, const RendererScene& scene,
                       const RendererDraw& draw, const DrawnAnswer& drawn,
                       const AnswerJson& conventions, const scene::CaseSpace& space,
                       const std::string& mesh, bool has_frame)
{
    std::string text = fmt::format("schema = 1\nname = {}\nrenderer = {}\n",
                                   scene::toml_quoted(said_excerpt(scene.name)),
                                   scene::toml_quoted(hello.title()));
    if (has_frame) {
        text += fmt::format("image = \"{}\"\n", frame_file);
    }
    AnswerJson files = AnswerJson::object();
    for (const auto& [key, file] : drawn.files) {
        files[key] = file;
    }
    text += toml_table("files", files);
    text += toml_table(
        "mesh", {{"file", mesh},
                 {"no_cast", objects_without(scene.triangles, &scene::Object::casts)},
                 {"no_receive", objects_without(scene.triangles, &scene::Object::receives)}});
    text += toml_table("camera", camera_table(scene.camera, space));
    text += toml_table("light", light_table(scene.light, space));
    text += toml_table("conventions", conventions);
    const AnswerJson settings = settings_tables(draw, drawn, space);
    for (const auto& [name, table] : settings.items()) {
        text += toml_table(name, table);
    }
    return text;
}

} // namespace gnomon::cli
