#include "scene/view/view.hpp"

#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/light/cube_faces.hpp"
#include "scene/light/fit_frustum.hpp"
#include "scene/light/sun.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <variant>

namespace gnomon::scene {
namespace {

/// Rounds a bias to float32 once. Refuses subnormals: GL may flush them, so that the verdict would
/// depend on the driver.
float rounded_bias(double value, std::string_view key)
{
    const auto result = static_cast<float>(value);
    if (!std::isfinite(result) || (value != 0 && std::fpclassify(result) != FP_NORMAL)) {
        throw InputError(fmt::format(
            "{} = {}: in depth units this is {:g}; a bias is 0 or a normal float32, of absolute "
            "value at least 1.18e-38",
            key, value, result));
    }
    return result;
}

float constant_bias(const BiasSettings& settings, const LightFrustum& frustum)
{
    const BiasUnit& unit = bias_unit_of(settings);
    if (!unit.is_depth() && frustum.projection == Projection::perspective) {
        throw InputError(fmt::format("{} needs a directional light: the depth of a spot or point "
                                     "light is not linear in {}; use {}",
                                     unit.key, unit.name, bias_in_depth.key));
    }
    return rounded_bias(constant_in_unit(settings) / unit.per_depth(frustum), unit.key);
}

/// The value if it is a number.
std::optional<double> number_of(const JobValue& value)
{
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return static_cast<double>(*integer);
    }
    const auto* real = std::get_if<double>(&value);
    return real == nullptr ? std::nullopt : std::optional{*real};
}

std::map<std::string, float, std::less<>> resolve_added_biases(const Job& job)
{
    std::map<std::string, float, std::less<>> biases;
    for (const Key& key : keys_of(job).rows()) {
        const std::string& name = key.name;
        if (!key.is_added() || key.table() != "bias" || !key.is_of(job.method.name)) {
            continue;
        }
        if (const auto number = number_of(key.value_of(job.method))) {
            biases.emplace(name, rounded_bias(*number, name));
        }
    }
    return biases;
}

/// The box that a default camera frames: everything except the ground.
Box framed_box(const TriangleScene& scene)
{
    Box box = scene.bounds();
    bool first = true;
    for (const Object& object : scene.objects) {
        if (object.name == "ground" || object.triangle_count == 0) {
            continue;
        }
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            for (const Vec3f& corner : scene.corners(object.first_triangle + t)) {
                box = first ? Box{Vec3d{corner}, Vec3d{corner}}
                            : Box{glm::min(box.lower, Vec3d{corner}),
                                  glm::max(box.upper, Vec3d{corner})};
                first = false;
            }
        }
    }
    return box;
}

/// Checks the layout here, because the scene's own light is not known earlier.
void require_layout(const Job& job, LightType light)
{
    const MapLayout layout = map_layout(job);
    const bool is_wrong_cube = (layout == MapLayout::cube) != shines_all_round(light);
    const bool is_wrong_cascade = layout == MapLayout::cascades && is_positional(light);
    if (is_wrong_cube || is_wrong_cascade) {
        throw InputError(fmt::format(
            "shadow_map.layout = \"{}\": the scene's light is a {} light; remove the key, or give "
            "a light under [light]",
            map_layout_name(layout), light_type_name(light)));
    }
    const MapContentTraits& content = traits_of(job.shadow_map.frustum.content);
    if (!content.is_gl_depth() && !is_positional(light)) {
        throw InputError(fmt::format("shadow_map.content = \"{}\": the scene's light is "
                                     "directional, and {}; remove the key, "
                                     "or give a light under [light]",
                                     content.name, content.why_positional));
    }
}

/// Refuses keys that the six maps of a scene's own point light do not use.
void require_no_other_cube(const Job& job)
{
    const auto refuse = [](const std::string& setting, std::string_view maps) {
        throw InputError(fmt::format("{}: the scene's light is a point light, whose six maps {}; "
                                     "remove the key",
                                     setting, maps));
    };
    const FrustumSettings& settings = job.shadow_map.frustum;
    if (lookup_position(job) != LookupPosition::pixel) {
        refuse("lookup.position = \"vertex\"", "are looked up from pixels");
    }
    if (settings.fit != Fit::scene) {
        refuse(fmt::format("shadow_map.fit = \"{}\"", fit_name(settings.fit)), "see all around");
    }
    if (settings.roll_deg != 0) {
        refuse(fmt::format("shadow_map.roll_deg = {}", settings.roll_deg),
               "look along the world's axes");
    }
}

void set_cascades(View& view, const Job& job, const TriangleScene& scene,
                  const LightSettings& light)
{
    const CascadeSettings& cascades = job.shadow_map.cascades;
    const std::vector<double> splits = split_view(cascades, scene, view.camera, view.image);
    view.maps = fit_cascades({cascades, job.shadow_map.frustum, light, view.light, scene,
                              view.camera, view.image, job.shadow_map.resolution_texels},
                             splits);
    view.map_choice = cascades.select == CascadeSelect::view_depth ? MapChoice::view_depth
                                                                   : MapChoice::containing;
    view.slices = {
        Vec3f{view.camera.eye}, Vec3f{view.camera.forward}, {}, static_cast<float>(splits.front())};
    for (std::size_t i = 1; i < splits.size(); ++i) {
        view.slices.ends.push_back(static_cast<float>(splits[i]));
        if (cascades.blend > 0) {
            const bool is_last = i + 1 == splits.size();
            const double share = is_last ? 0 : cascades.blend;
            view.slices.mixed_from.push_back(
                static_cast<float>(splits[i] - share * (splits[i] - splits[i - 1])));
        }
    }
}

void set_maps(View& view, const Job& job, const TriangleScene& scene, const LightSettings& light)
{
    switch (map_layout(job)) {
    case MapLayout::single:
        view.maps = {fit_light_frustum(job.shadow_map.frustum, light, view.light, scene,
                                       view.camera, view.image)};
        return;
    case MapLayout::cube:
        require_no_other_cube(job);
        view.maps = fit_cube_faces(job.shadow_map.frustum, view.light, scene);
        view.map_choice = MapChoice::cube_face;
        return;
    case MapLayout::cascades:
        set_cascades(view, job, scene, light);
        return;
    }
}

/// Scales that make a bias in another unit equally long in every map.
std::vector<float> bias_scales_of(const Job& job, const View& view)
{
    std::vector<float> scales;
    if (scales_bias(job)) {
        const BiasUnit& unit = bias_unit_of(job.bias);
        for (const LightFrustum& map : view.maps) {
            scales.push_back(
                static_cast<float>(unit.per_depth(view.first_map()) / unit.per_depth(map)));
        }
    }
    return scales;
}

LightSettings default_light()
{
    LightSettings light;
    light.direction = Vec3d{-0.4, -1, -0.3};
    return light;
}

} // namespace

std::optional<float> Bias::find_added(std::string_view key) const
{
    const auto found = added.find(key);
    return found == added.end() ? std::nullopt : std::optional{found->second};
}

const LightFrustum& View::first_map() const
{
    if (maps.empty()) {
        throw std::logic_error("View: the light has no shadow map");
    }
    return maps.front();
}

double View::light_distance_m(const Vec3d& point) const
{
    const std::size_t map =
        maps.size() > 1 ? chosen_map(maps, map_choice, slices, Vec3f{point}) : 0;
    return map < maps.size() ? maps[map].light_distance_m(point)
                             : first_map().light_distance_m(point);
}

std::string View::map_name(std::size_t map) const
{
    return map_choice == MapChoice::cube_face ? std::string{cube_faces.at(map).name}
                                              : std::to_string(map);
}

Bias resolve_bias(const BiasSettings& settings, const LightFrustum& frustum)
{
    return {constant_bias(settings, frustum), rounded_bias(settings.slope, "bias.slope"),
            rounded_bias(settings.normal_texels, "bias.normal_texels")};
}

CameraSettings resolve_camera(const Job& job, const TriangleScene& scene,
                              const SceneDefaults& defaults)
{
    const auto camera = job.camera ? job.camera : defaults.camera;
    return camera ? *camera : frame_box(framed_box(scene), job.image);
}

CameraSettings aimed_camera(const Job& job, const TriangleScene& scene,
                            const SceneDefaults& defaults)
{
    constexpr double nearest_target = 1e-2; // of the scene's diagonal
    CameraSettings camera = resolve_camera(job, scene, defaults);
    if (!job.camera && defaults.camera) {
        const Box box = scene.bounds();
        const Vec3d forward = make_camera(camera).forward;
        const double ahead_m = std::max(glm::dot(box.centre() - camera.eye, forward),
                                        nearest_target * box.diagonal_m());
        camera.target = camera.eye + ahead_m * forward;
    }
    return camera;
}

LightSettings resolve_light(const Job& job, const SceneDefaults& defaults)
{
    const auto light = job.light ? job.light : defaults.light;
    return light ? with_direction(*light, job.scene.north.value_or(usual_north)) : default_light();
}

Job with_layout(Job job, const SceneDefaults& defaults)
{
    const auto light = job.light ? job.light : defaults.light;
    if (!job.shadow_map.layout && shines_all_round(light.value_or(default_light()).type)) {
        job.shadow_map.layout = MapLayout::cube;
    }
    return job;
}

View resolve_view_without_maps(const Job& job, const TriangleScene& scene,
                               const SceneDefaults& defaults)
{
    View view;
    view.image = job.image;
    view.camera = make_camera(resolve_camera(job, scene, defaults));
    view.light = make_light(resolve_light(job, defaults));
    return view;
}

View resolve_view(const Job& job, const TriangleScene& scene, const SceneDefaults& defaults)
{
    View view = resolve_view_without_maps(job, scene, defaults);
    const Job with_own_layout = with_layout(job, defaults);
    require_layout(with_own_layout, view.light.type);
    set_maps(view, with_own_layout, scene, resolve_light(job, defaults));
    view.bias = resolve_bias(job.bias, view.first_map());
    view.bias.added = resolve_added_biases(job);
    view.bias_scales = bias_scales_of(job, view);
    return view;
}

} // namespace gnomon::scene
