#pragma once

#include "scene/camera/camera.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/geometry/file_space.hpp"
#include "scene/image.hpp"
#include "scene/light/cascades.hpp"
#include "scene/light/frustum.hpp"
#include "scene/light/light.hpp"
#include "scene/settings/filter.hpp"
#include "scene/vec.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::scene {

struct BiasSettings {
    double constant = 0;                   ///< depth units [0,1]; unused if another unit is set
    std::optional<double> constant_m = {}; ///< metres along a directional light's axis
    double slope = 0;                      ///< depth units per unit of tan θ
    double normal_texels = 0;              ///< normal offset, in texel widths at P
};

/// A unit of the constant bias: depth units, or a unit that is linear in the distance along a
/// directional light's axis. A job uses one of them.
struct BiasUnit {
    std::string_view key;
    std::string_view name;    ///< "metres"
    std::string_view symbol;  ///< the key's own unit, "m"
    std::string_view meaning; ///< the key's `Key::description`
    std::string_view default_text;
    std::string_view example;
    double largest = 0;                           ///< the largest absolute value of the key
    std::optional<double> BiasSettings::*member;  ///< nullptr: `constant`
    double (*per_depth)(const LightFrustum& map); ///< this unit's value of one depth unit
    std::string_view shader_per_depth;            ///< `per_depth` in a shader with cascades

    [[nodiscard]] constexpr bool is_depth() const { return member == nullptr; }
};

/// All units. Everything that reads, writes or converts a constant bias uses these rows.
inline constexpr auto bias_units = std::to_array<BiasUnit>({
    {"bias.constant", "depth units", "depth units", "constant bias, {unit}; or constant_m instead",
     "0", "", 1, nullptr, [](const LightFrustum& /*map*/) { return 1.0; }, ""},
    {"bias.constant_m", "metres", "m",
     "constant bias [{unit}] along a directional light's axis, in place of constant", "", "0.01",
     1e15, &BiasSettings::constant_m, [](const LightFrustum& map) { return map.range_m(); },
     "(far[cascade] - near[cascade])"},
});
inline constexpr const BiasUnit& bias_in_depth = bias_units[0];
inline constexpr const BiasUnit& bias_in_metres = bias_units[1];

/// Whether the key is a constant bias, for which the bias curve covers every value.
[[nodiscard]] constexpr bool is_constant_bias(std::string_view key)
{
    return std::ranges::find(bias_units, key, &BiasUnit::key) != bias_units.end();
}

/// The unit of the constant bias.
[[nodiscard]] inline const BiasUnit& bias_unit_of(const BiasSettings& settings)
{
    const auto found = std::ranges::find_if(bias_units, [&](const BiasUnit& unit) {
        return !unit.is_depth() && (settings.*unit.member).has_value();
    });
    return found == bias_units.end() ? bias_in_depth : *found;
}

/// The constant bias in its unit.
[[nodiscard]] inline double constant_in_unit(const BiasSettings& settings)
{
    const BiasUnit& unit = bias_unit_of(settings);
    return unit.is_depth() ? settings.constant : *(settings.*unit.member);
}

/// Replaces the constant bias of the settings.
inline void set_constant(BiasSettings& settings, const BiasUnit& unit, double value)
{
    for (const BiasUnit& other : bias_units) {
        if (!other.is_depth()) {
            (settings.*other.member).reset();
        }
    }
    settings.constant = unit.is_depth() ? value : 0;
    if (!unit.is_depth()) {
        settings.*unit.member = value;
    }
}

class KeyTable;

/// A value that a key accepted.
using JobValue =
    std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>, Vec3d>;

/// A parameter of a built-in scene: a number or one of a few words.
using SceneParameter = std::variant<double, std::string>;

/// The job's `[scene]` table: exactly one of `builtin` and `file` is set.
struct SceneSettings {
    std::string builtin;
    std::filesystem::path file;   ///< resolved against the job file's folder
    std::optional<double> unit_m; ///< of the file; empty: lengths are not scaled
    UpAxis up = UpAxis::y;        ///< of the file
    std::optional<Vec3d> north;   ///< its horizontal part is north for `light.sun`; default −z
    bool ground = false;
    std::vector<std::string> no_cast;
    std::vector<std::string> no_receive;
    std::map<std::string, SceneParameter> parameters; ///< `[scene.NAME]`, of a built-in

    [[nodiscard]] FileSpace file_space() const { return {unit_m.value_or(1), up}; }
};

/// The unit of a scene's lengths: "m", or "units" if the file's unit is unknown.
[[nodiscard]] std::string_view length_unit(const SceneSettings& scene);

enum class Cull : std::uint8_t { none, front, back };

/// The number of a light's maps, and what each covers.
enum class MapLayout : std::uint8_t {
    single,   ///< one
    cube,     ///< the six faces of a cube, for point lights (`cube_faces`)
    cascades, ///< one per slice of the camera's view, for directional lights (`fit_cascades`)
};
enum class Outside : std::uint8_t { lit, shadowed, clamp };

/// Where the light's clip position of a receiver is computed.
enum class LookupPosition : std::uint8_t {
    vertex, ///< at the vertices; interpolated, as shadow-map lessons do
    pixel,  ///< at the pixel, from the interpolated world position, as engines do
};

[[nodiscard]] std::string_view outside_name(Outside outside);
[[nodiscard]] std::string_view lookup_position_name(LookupPosition position);
[[nodiscard]] std::string_view cull_name(Cull cull);
[[nodiscard]] std::string_view map_layout_name(MapLayout layout);
[[nodiscard]] std::string_view fit_name(Fit fit);

/// The job's `[method]` table.
struct MethodSettings {
    std::string name = "depth";
    /// The job's values of keys that higher layers add (`Key::is_added`), by name.
    std::map<std::string, JobValue, std::less<>> values;

    friend bool operator==(const MethodSettings&, const MethodSettings&) = default;
};

struct ShadowMapSettings {
    std::optional<MapLayout> layout; ///< empty: the light's own (`map_layout`)
    int resolution_texels = 1024;    ///< [1, 16384]
    DepthFormat depth_format;
    FrustumSettings frustum;
    CascadeSettings cascades; ///< layout = cascades
    Cull cull = Cull::none;
};

struct LookupSettings {
    Filter filter = Filter::nearest;
    Outside outside = Outside::lit;
    std::optional<LookupPosition> position; ///< empty: the layout's own (`lookup_position`)
};

/// A job. Every member has the default given in docs/job_file.md.
struct Job {
    SceneSettings scene;
    std::optional<CameraSettings> camera; ///< empty: from the scene file, else framed
    ImageSize image;
    std::optional<LightSettings> light; ///< empty: from the scene file, else (-0.4, -1, -0.3)
    MethodSettings method;
    ShadowMapSettings shadow_map;
    LookupSettings lookup;
    BiasSettings bias;
    std::shared_ptr<const KeyTable> keys; ///< with which it was read; empty: `own_keys`
};

/// The layout of a job's maps: as given, or else `cube` for a point light and `single` for others.
[[nodiscard]] MapLayout map_layout(const Job& job);
/// The number of maps of the job's light.
[[nodiscard]] std::size_t map_count(const Job& job);
/// Whether each cascade needs a different number of depth units for the same bias length, because
/// the job gives the bias in another unit.
[[nodiscard]] bool scales_bias(const Job& job);
/// Replaces the job's constant bias: in the given unit if it is then equally long in all maps, else
/// in depth units.
/// @param value  In the unit.
/// @param depth  The bias in depth units.
void set_constant(Job& job, const BiasUnit& unit, double value, double depth);
/// Whether verdicts of neighbouring cascades are blended.
[[nodiscard]] bool mixes_maps(const Job& job);
/// The lookup position: as given, or else `pixel` for several maps and `vertex` for one.
[[nodiscard]] LookupPosition lookup_position(const Job& job);

} // namespace gnomon::scene
