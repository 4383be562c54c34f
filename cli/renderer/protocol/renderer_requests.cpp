#include "cli/renderer/protocol/renderer_requests.hpp"

#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace gnomon::cli {
namespace {

constexpr std::array<std::string_view, 4> sent_tables{"shadow_map", "lookup", "bias", "method"};

AnswerJson vector_json(const scene::Vec3d& v)
{
    return {v.x, v.y, v.z};
}

AnswerJson camera_json(const scene::CameraSettings& camera)
{
    AnswerJson json{{"eye", vector_json(scene::rounded_to_float32(camera.eye))},
                    {"target", vector_json(camera.target)},
                    {"up", vector_json(camera.up)}};
    if (camera.projection == scene::Projection::perspective) {
        json["vertical_fov_deg"] = camera.vertical_fov_deg;
    } else {
        json["orthographic_height"] = camera.orthographic_height_m;
    }
    return json;
}

AnswerJson light_json(const scene::LightSettings& settings)
{
    const scene::Light light = scene::make_light(settings);
    AnswerJson json{{"type", scene::light_type_name(settings.type)}};
    if (light.has_position()) {
        json["position"] = vector_json(light.position);
    } else {
        json["direction"] = vector_json(light.direction);
    }
    if (scene::has_cone(settings.type)) {
        json["target"] = vector_json(scene::rounded_to_float32(*settings.target));
        json["cone_deg"] = settings.cone_deg;
    }
    return json;
}

/// Row-major.
AnswerJson matrix_json(const scene::Mat4f& matrix)
{
    AnswerJson numbers = AnswerJson::array();
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            numbers.push_back(double{matrix[column][row]});
        }
    }
    return numbers;
}

/// The frustum of one map.
AnswerJson map_json(const scene::LightFrustum& map)
{
    AnswerJson json{{"near", map.near_m},
                    {"far", map.far_m},
                    {"light_clip_from_world", matrix_json(map.light_clip_from_world)}};
    if (map.projection == scene::Projection::perspective) {
        json["vertical_fov_deg"] =
            (std::atan(map.top) - std::atan(map.bottom)) * 180 / std::numbers::pi;
    } else {
        json["half_extent"] = std::max(map.right_side - map.left, map.top - map.bottom) / 2;
    }
    json["light_camera"] = {{"projection", scene::projection_name(map.projection)},
                            {"position", vector_json(map.origin)},
                            {"forward", vector_json(map.forward)},
                            {"up", vector_json(map.up)},
                            {"left", map.left},
                            {"right", map.right_side},
                            {"bottom", map.bottom},
                            {"top", map.top}};
    return json;
}

/// The resolution and the frustums that Gnomon's own maps would have.
AnswerJson maps_json(const RendererDraw& draw)
{
    const scene::View& view = draw.view;
    AnswerJson json{{"resolution", draw.job.shadow_map.resolution_texels}};
    json.update(map_json(view.first_map()));
    if (view.maps.size() > 1) {
        json["maps"] = AnswerJson::array();
        for (std::size_t i = 0; i < view.maps.size(); ++i) {
            AnswerJson map{{"name", view.map_name(i)}};
            map.update(map_json(view.maps[i]));
            json["maps"].push_back(std::move(map));
        }
    }
    return json;
}

} // namespace

std::vector<std::string> objects_without(const scene::TriangleScene& scene,
                                         bool scene::Object::*role)
{
    std::vector<std::string> names;
    for (const scene::Object& object : scene.objects) {
        if (!(object.*role)) {
            names.push_back(object.name);
        }
    }
    return names;
}

AnswerJson given_tables(const RendererDraw& draw)
{
    AnswerJson tables = AnswerJson::object();
    for (const std::string& name : draw.given) {
        const scene::Key* const spec = scene::keys_of(draw.job).find(name);
        const std::string table = name.substr(0, name.find('.'));
        if (spec == nullptr || std::ranges::find(sent_tables, table) == sent_tables.end()) {
            continue;
        }
        if (const auto value = spec->get(draw.job)) {
            tables[table][std::string{scene::key_leaf(name)}] = to_json(*value);
        }
    }
    return tables;
}

AnswerJson open_request(const RendererScene& scene, const std::filesystem::path& mesh)
{
    return {{"mesh",
             {{"file", mesh.string()},
              {"no_cast", objects_without(scene.triangles, &scene::Object::casts)},
              {"no_receive", objects_without(scene.triangles, &scene::Object::receives)}}},
            {"camera", camera_json(scene.camera)},
            {"light", light_json(scene.light)},
            {"image", {{"width", scene.image.width_px}, {"height", scene.image.height_px}}}};
}

AnswerJson draw_request(const RendererDraw& draw)
{
    AnswerJson request{{"shadow_map", AnswerJson::object()},
                       {"lookup", AnswerJson::object()},
                       {"bias", AnswerJson::object()}};
    request.update(given_tables(draw));
    // The job's near and far may be words; these are numbers.
    request["shadow_map"].update(maps_json(draw));
    request["engine"] = AnswerJson::object();
    for (const auto& [name, value] : draw.engine) {
        request["engine"][name] = to_json(value);
    }
    return request;
}

} // namespace gnomon::cli
