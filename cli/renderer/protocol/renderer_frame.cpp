#include "cli/renderer/protocol/renderer_frame.hpp"

#include "scene/job/toml.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <type_traits>

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
        throw BadAnswer(fmt::format("{} is {}; case.toml cannot express it", said_excerpt(name),
                                    answer_excerpt(value)));
    }
    std::string list;
    for (const AnswerJson& item : value) {
        list += fmt::format("{}{}", list.empty() ? "" : ", ", toml_value(item, name));
    }
    return fmt::format("[{}]", list);
}

/// The table's lines; tables inside it become dotted keys.
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

/// Turns a direction into the renderer's axes; keeps its length.
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

/// The requested settings, replaced by those that the renderer says it used.
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

template <typename Pixel>
std::string difference(std::string_view name, const scene::Image<Pixel>& a,
                       const scene::Image<Pixel>& b)
{
    static_assert(std::is_trivially_copyable_v<Pixel>);
    if (a.size() != b.size()) {
        return fmt::format("{} is {}x{} in one and {}x{} in the other", name, a.size().width_px,
                           a.size().height_px, b.size().width_px, b.size().height_px);
    }
    using Bits = std::array<std::byte, sizeof(Pixel)>; // equal for equal NaNs
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        if (std::bit_cast<Bits>(a[i]) != std::bit_cast<Bits>(b[i])) {
            first = count == 0 ? i : first;
            ++count;
        }
    }
    const auto width = static_cast<std::size_t>(a.size().width_px);
    return count == 0 ? std::string{}
                      : fmt::format("{} differs at {} pixel{}, first at ({}, {})", name, count,
                                    count == 1 ? "" : "s", first % width, first / width);
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

std::string frame_difference(const scene::CaseLayers& a, const scene::CaseLayers& b)
{
    for (const std::string& found :
         {difference("the mask", a.mask, b.mask), difference("P", a.position, b.position),
          difference("Ng", a.normal, b.normal),
          difference("id.geom", a.object_number, b.object_number),
          difference("z.light", a.z_light, b.z_light), difference("z.map", a.z_map, b.z_map),
          difference("texel", a.texels, b.texels), difference("map_index", a.maps, b.maps),
          difference("kernel_axis", a.kernel_axes, b.kernel_axes),
          difference("tan_theta", a.tan_theta, b.tan_theta),
          difference("moved", a.terms.moved, b.terms.moved),
          difference("tap_gradient", a.terms.gradients, b.terms.gradients),
          difference("unmoved", a.unmoved.samples, b.unmoved.samples),
          difference("unmoved.texel", a.unmoved.texels, b.unmoved.texels),
          difference("map.d", a.map_depths, b.map_depths)}) {
        if (!found.empty()) {
            return found;
        }
    }
    return {};
}

} // namespace gnomon::cli
