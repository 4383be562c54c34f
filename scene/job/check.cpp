#include "scene/depth/depth_format.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/keys/keys.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/light/sun.hpp"
#include "scene/settings/job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::scene {
namespace {

/// Most pixels of an image: 16384 x 8192.
constexpr std::int64_t most_pixels = 134'217'728;

/// Refuses `first` and `second` together.
void check_exclusive(const Settings& settings, std::string_view first, std::string_view second)
{
    const Setting* a = find_setting(settings, first);
    const Setting* b = find_setting(settings, second);
    if (a != nullptr && b != nullptr) {
        refuse(*b, fmt::format("{} and this key are mutually exclusive ({}); keep one of the two",
                               first, a->label));
    }
}

/// The light's type, if the settings give one; empty if the scene decides.
std::optional<LightType> known_light(const Settings& settings)
{
    const auto first = settings.lower_bound("light.");
    if (first == settings.end() || !first->first.starts_with("light.")) {
        return std::nullopt;
    }
    const Setting* type = find_setting(settings, "light.type");
    return type == nullptr ? LightSettings{}.type
                           : light_type_from_name(std::get<std::string>(type->value));
}

/// The corresponding key for another type of light; empty without one.
std::string_view sibling_of(const KeyTable& keys, std::string_view key, LightType light)
{
    constexpr std::array<std::string_view, 2> sizes{"shadow_map.half_extent", "shadow_map.fov_deg"};
    const auto own = std::ranges::find_if(
        sizes, [&](std::string_view size) { return keys.find(size)->is_of(light); });
    return std::ranges::find(sizes, key) != sizes.end() && own != sizes.end() ? *own
                                                                              : std::string_view{};
}

/// Refuses keys that other types of light have.
void check_light_keys(const KeyTable& keys, const Settings& settings, LightType light)
{
    const Setting* type = find_setting(settings, "light.type");
    for (const auto& [key, setting] : settings) {
        if (setting.spec->is_of(light)) {
            continue;
        }
        std::vector<std::string_view> having;
        std::ranges::transform(setting.spec->lights, std::back_inserter(having), light_type_name);
        const std::string_view sibling = sibling_of(keys, key, light);
        refuse(setting,
               fmt::format("is for a {} light, and this is a {} light{}; remove it, or {}",
                           fmt::join(having, " or "), light_type_name(light),
                           type == nullptr ? "" : fmt::format(" ({})", type->label),
                           sibling.empty() ? fmt::format("set light.type = \"{}\"", having.front())
                                           : fmt::format("use {}", sibling)));
    }
}

/// Refuses an incomplete sun, a sun next to a direction, and a sun below the horizon.
void check_sun(const Settings& settings)
{
    constexpr std::array<std::string_view, 3> keys{"light.sun.latitude_deg",
                                                   "light.sun.longitude_deg", "light.sun.time"};
    for (const std::string_view given : keys) {
        const Setting* setting = find_setting(settings, given);
        for (const std::string_view needed : keys) {
            if (setting != nullptr && find_setting(settings, needed) == nullptr) {
                refuse(*setting,
                       fmt::format("a sun needs a place and a time; {} is missing", needed));
            }
        }
        check_exclusive(settings, "light.direction", given);
        check_exclusive(settings, "light.target", given);
    }
    if (const Setting* time = find_setting(settings, keys[2])) {
        const auto degrees = [&](std::string_view key) {
            return std::get<double>(settings.find(key)->second.value);
        };
        const SunPosition sun = sun_position(degrees(keys[0]), degrees(keys[1]),
                                             utc_time(std::get<std::string>(time->value)).value());
        if (sun.elevation_deg <= 0) {
            refuse(*time, fmt::format("the sun is {:.1f} degrees below the horizon then; choose "
                                      "another time",
                                      -sun.elevation_deg));
        }
    }
}

void check_north(const Settings& settings)
{
    const Setting* north = find_setting(settings, "scene.north");
    const Vec3d way = north != nullptr ? std::get<Vec3d>(north->value) : usual_north;
    if (way.x == 0 && way.z == 0) {
        refuse(*north, "is up or down; must have a horizontal part");
    }
}

/// Refuses a light with missing or contradictory keys.
void check_place(const Settings& settings, LightType light)
{
    if (light == LightType::directional) {
        check_exclusive(settings, "light.direction", "light.target");
        check_sun(settings);
        const Setting* target = find_setting(settings, "light.target");
        if (target != nullptr && find_setting(settings, "light.position") == nullptr) {
            refuse(*target, "needs light.position: together they give a directional light's "
                            "direction; or set light.direction instead");
        }
        return;
    }
    const auto require = [&](std::string_view key) {
        if (find_setting(settings, key) == nullptr) {
            refuse(settings.at("light.type"),
                   fmt::format("a {} light needs {}", light_type_name(light), key));
        }
    };
    require("light.position");
    if (has_cone(light)) {
        require("light.target");
    }
}

void check_fit(const Settings& settings)
{
    const Setting* fit = find_setting(settings, "shadow_map.fit");
    const bool is_fixed = fit != nullptr && std::get<std::string>(fit->value) == "fixed";
    for (const std::string_view key : {"shadow_map.half_extent", "shadow_map.fov_deg"}) {
        const Setting* size = find_setting(settings, key);
        if (size != nullptr && !is_fixed) {
            refuse(*size, "only for shadow_map.fit = \"fixed\"; set that too, or remove this key");
        }
    }
}

/// Refuses settings that only apply to maps of GL's own depth.
void check_content(const Settings& settings, std::optional<LightType> light)
{
    const Setting* content = find_setting(settings, "shadow_map.content");
    if (content == nullptr) {
        return;
    }
    const MapContentTraits& traits =
        traits_of(map_content_from_name(std::get<std::string>(content->value)).value());
    if (traits.is_gl_depth()) {
        return;
    }
    if (light && !is_positional(*light)) {
        refuse(*content, fmt::format("{}; remove it", traits.why_positional));
    }
    const Setting* reversed = find_setting(settings, "shadow_map.reversed");
    if (reversed != nullptr && std::get<bool>(reversed->value)) {
        refuse(*reversed, fmt::format("is for depth, not for {} ({}); keep one of the two",
                                      traits.noun, content->label));
    }
    const Setting* filter = find_setting(settings, "lookup.filter");
    if (traits.is_root() && filter != nullptr && std::get<std::string>(filter->value) == "linear") {
        refuse(*filter,
               fmt::format(
                   "a mean of {} ({}) cannot be decided exactly; use nearest, hardware or a pcf",
                   traits.noun, content->label));
    }
}

/// Refuses filters that the format does not support.
void check_format(const Settings& settings)
{
    const Setting* format = find_setting(settings, "shadow_map.depth_format");
    const Setting* filter = find_setting(settings, "lookup.filter");
    if (format == nullptr || filter == nullptr) {
        return; // d24 has every filter, and nearest takes every format
    }
    const DepthFormatTraits& traits =
        traits_of(depth_format_from_name(std::get<std::string>(format->value)).value());
    const std::string& name = std::get<std::string>(filter->value);
    if (name == "hardware" && traits.is_colour) {
        refuse(*filter, fmt::format("GL compares only depth formats, and this is a colour format "
                                    "({}); use nearest or a pcf, or d16, d24 or d32f",
                                    format->label));
    }
    if (name == "linear" && !traits.has_means) {
        refuse(
            *filter,
            fmt::format("a mean of packed bytes is not a mean of depths ({}); use nearest or a pcf",
                        format->label));
    }
}

/// The layout: given or implied.
MapLayout known_layout(const Settings& settings, bool shines_all_round)
{
    const Setting* layout = find_setting(settings, "shadow_map.layout");
    if (layout == nullptr) {
        return shines_all_round ? MapLayout::cube : MapLayout::single;
    }
    const std::string& name = std::get<std::string>(layout->value);
    return name == "cube"       ? MapLayout::cube
           : name == "cascades" ? MapLayout::cascades
                                : MapLayout::single;
}

/// Refuses map layouts that the light cannot have.
void check_layout_of_light(const Settings& settings, MapLayout layout, LightType light)
{
    const Setting* setting = find_setting(settings, "shadow_map.layout");
    if (setting == nullptr) {
        return;
    }
    if (layout != MapLayout::cube && shines_all_round(light)) {
        refuse(*setting, fmt::format("a point light's maps are the faces of a cube; remove it, or "
                                     "set light.type = \"{}\"",
                                     layout == MapLayout::cascades ? "directional" : "spot"));
    }
    if (layout == MapLayout::cube && !shines_all_round(light)) {
        refuse(*setting, "only a point light's maps are the faces of a cube; remove it, or set "
                         "light.type = \"point\"");
    }
    if (layout == MapLayout::cascades && is_positional(light)) {
        refuse(*setting, "only directional lights have cascades; remove it, or set light.type = "
                         "\"directional\"");
    }
}

/// Refuses keys that cube maps or cascades do not use.
void check_keys_of_layout(const Settings& settings, MapLayout layout)
{
    const bool is_cube = layout == MapLayout::cube;
    const std::string_view maps = is_cube ? "a point light" : "cascades";
    const std::string_view why =
        is_cube ? "its six maps see all around" : "each map has a slice of the camera's view";
    for (const auto& [key, word] :
         {std::pair{"shadow_map.fit", "scene"}, {"lookup.position", "pixel"}}) {
        const Setting* setting = find_setting(settings, key);
        if (setting != nullptr && std::get<std::string>(setting->value) != word) {
            refuse(*setting,
                   fmt::format("with {} it is \"{}\", for {}; remove it", maps, word, why));
        }
    }
    const Setting* roll = find_setting(settings, "shadow_map.roll_deg");
    if (is_cube && roll != nullptr && std::get<double>(roll->value) != 0) {
        refuse(*roll, "a point light's maps look along the world's axes; remove it, or turn the "
                      "scene");
    }
}

/// Refuses map layouts that the light cannot have, and keys that the layout does not use.
void check_layout(const Settings& settings, std::optional<LightType> light)
{
    const bool has_cube = light && shines_all_round(*light);
    const MapLayout layout = known_layout(settings, has_cube);
    if (light) {
        check_layout_of_light(settings, layout, *light);
    }
    if (layout == MapLayout::cascades || (layout == MapLayout::cube && has_cube)) {
        check_keys_of_layout(settings, layout);
    }
}

void check_planes(const Settings& settings, std::optional<LightType> light)
{
    const auto number = [&](std::string_view key) -> const double* {
        const Setting* setting = find_setting(settings, key);
        return setting == nullptr ? nullptr : std::get_if<double>(&setting->value);
    };
    const double* near_m = number("shadow_map.near");
    const double* far_m = number("shadow_map.far");
    for (const auto& [key, plane_m] :
         {std::pair{"shadow_map.near", near_m}, {"shadow_map.far", far_m}}) {
        if (plane_m != nullptr && light && is_positional(*light) && !(*plane_m > 0)) {
            refuse(settings.at(key),
                   fmt::format("must be above 0 for a {} light", light_type_name(*light)));
        }
    }
    if (near_m != nullptr && far_m != nullptr && !(*near_m < *far_m)) {
        refuse(settings.at("shadow_map.near"), fmt::format("must be less than shadow_map.far ({})",
                                                           settings.at("shadow_map.far").label));
    }
}

void check_bias(const Settings& settings, std::optional<LightType> light)
{
    for (auto unit = bias_units.begin(); unit != bias_units.end(); ++unit) {
        for (auto other = bias_units.begin(); other != unit; ++other) {
            check_exclusive(settings, other->key, unit->key);
        }
        const Setting* setting = find_setting(settings, unit->key);
        if (setting != nullptr && !unit->is_depth() && light && is_positional(*light)) {
            refuse(*setting, fmt::format("a {} light's depth is not linear in {}; use {}",
                                         light_type_name(*light), unit->name, bias_in_depth.key));
        }
    }
}

/// Refuses keys that the job's method does not have.
void check_method(const KeyTable& keys, const Settings& settings)
{
    const Setting* chosen = find_setting(settings, "method.name");
    const std::string name =
        chosen != nullptr ? std::get<std::string>(chosen->value) : keys.default_method();
    for (const auto& [key, setting] : settings) {
        if (!keys.has_key(name, key)) {
            const std::string why =
                key == "lookup.filter"
                    ? fmt::format("the method {} has no filter; remove it", name)
                    : fmt::format("the method {} reads no [{}]; remove all of that table's keys",
                                  name, key.substr(0, key.find('.')));
            refuse(setting, why);
        }
        const Key& row = *setting.spec;
        if (row.is_added() && !row.is_of(name)) {
            refuse(setting,
                   fmt::format("is for method.name = \"{}\", and the job's method is \"{}\"; "
                               "remove it, or set that",
                               fmt::join(row.methods.value(), "\" or \""), name));
        }
    }
}

void check_image(const Settings& settings)
{
    const Setting* width = find_setting(settings, "image.width");
    const Setting* height = find_setting(settings, "image.height");
    if (width == nullptr || height == nullptr) {
        return; // the default of one side keeps within the limit
    }
    const auto pixels =
        std::get<std::int64_t>(width->value) * std::get<std::int64_t>(height->value);
    if (pixels > most_pixels) {
        refuse(*width, fmt::format("times image.height ({}) is {} pixels; must be at most {}",
                                   height->label, pixels, most_pixels));
    }
}

} // namespace

void check_scene_choice(const KeyTable& keys, const Settings& settings, const std::string& source)
{
    const Setting* builtin = find_setting(settings, "scene.builtin");
    check_exclusive(settings, "scene.builtin", "scene.file");
    if (builtin == nullptr && find_setting(settings, "scene.file") == nullptr) {
        throw InputError(source + ": no scene: set scene.builtin (`gnomon scenes` lists them) or "
                                  "scene.file");
    }
    for (const std::string_view key : {"scene.unit_m", "scene.up"}) {
        const Setting* setting = find_setting(settings, key);
        if (builtin != nullptr && setting != nullptr) {
            refuse(*setting, "only a scene.file has a unit and an axis up of its own; remove it");
        }
    }
    const std::string known =
        builtin != nullptr ? parameter_prefix(std::get<std::string>(builtin->value)) : "";
    for (const Key& spec : keys.rows()) {
        const std::string_view key = spec.name;
        const bool is_foreign = key.starts_with("scene.") && key.find('.', 6) != key.npos &&
                                (known.empty() || !key.starts_with(known));
        const Setting* setting = find_setting(settings, key);
        if (is_foreign && setting != nullptr) {
            refuse(*setting, fmt::format("the parameter of a scene that this job does not show; "
                                         "remove it, or set scene.builtin = \"{}\"",
                                         key.substr(6, key.find('.', 6) - 6)));
        }
    }
}

void check_settings(const KeyTable& keys, const Settings& settings, const std::string& source)
{
    check_scene_choice(keys, settings, source);
    check_exclusive(settings, "camera.vertical_fov_deg", "camera.orthographic_height");
    const std::optional<LightType> light = known_light(settings);
    if (light) {
        check_light_keys(keys, settings, *light);
        check_place(settings, *light);
    }
    check_north(settings);
    check_layout(settings, light);
    check_cascades(settings);
    check_content(settings, light);
    check_format(settings);
    check_fit(settings);
    check_planes(settings, light);
    check_bias(settings, light);
    check_method(keys, settings);
    check_image(settings);
}

} // namespace gnomon::scene
