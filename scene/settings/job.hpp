#pragma once

#include "scene/camera/camera.hpp"
#include "scene/depth/depth_format.hpp"
#include "scene/geometry/file_space.hpp"
#include "scene/image.hpp"
#include "scene/light/cascades.hpp"
#include "scene/light/frustum.hpp"
#include "scene/light/light.hpp"
#include "scene/settings/bias_settings.hpp"
#include "scene/settings/filter.hpp"
#include "scene/vec.hpp"

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
    std::optional<double> unit_m; ///< of the file; empty: its lengths are taken as they are
    UpAxis up = UpAxis::y;        ///< of the file
    std::optional<Vec3d> north;   ///< whose horizontal part `light.sun` goes by; else −z
    bool ground = false;
    std::vector<std::string> no_cast;
    std::vector<std::string> no_receive;
    std::map<std::string, SceneParameter> parameters; ///< `[scene.NAME]`, of a built-in

    [[nodiscard]] FileSpace file_space() const { return {unit_m.value_or(1), up}; }
};

/// What a scene's lengths are in, for people: "m", or "units" of a file whose unit is not said.
[[nodiscard]] std::string_view length_unit(const SceneSettings& scene);

enum class Cull : std::uint8_t { none, front, back };

/// How many maps a light has, and what each of them sees.
enum class MapLayout : std::uint8_t {
    single,   ///< one
    cube,     ///< of a point light the six faces of a cube (`cube_faces`)
    cascades, ///< of a directional light one for each slice of the camera's view (`fit_cascades`)
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

/// The job's `[method]` table: what decides verdicts, and how.
struct MethodSettings {
    std::string name = "depth";
    /// What the job sets of the keys that layers above add (`Key::is_added`), by name.
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

/// A job: what to look at, and how. Every member has the default that docs/job_file.md gives.
struct Job {
    SceneSettings scene;
    std::optional<CameraSettings> camera; ///< empty: from the scene file, else framed
    ImageSize image;
    std::optional<LightSettings> light; ///< empty: from the scene file, else (-0.4, -1, -0.3)
    MethodSettings method;
    ShadowMapSettings shadow_map;
    LookupSettings lookup;
    BiasSettings bias;
    std::shared_ptr<const KeyTable> keys; ///< that it was read with; empty: the scene's own
};

/// The layout of a job's maps: what it says, or `cube` for a point light, else `single`.
[[nodiscard]] MapLayout map_layout(const Job& job);
/// How many maps its light has.
[[nodiscard]] std::size_t map_count(const Job& job);
/// Whether the constant bias is another number of depth units in each map, to be as long in all: in
/// another unit, over cascades.
[[nodiscard]] bool scales_bias(const Job& job);
/// Puts a constant bias in place of the job's own: in the unit where it then is as long in all
/// maps, else in depth units.
/// @param value  In the unit.
/// @param depth  The same in depth units.
void set_constant(Job& job, const BiasUnit& unit, double value, double depth);
/// Whether verdicts of neighbouring cascades are mixed.
[[nodiscard]] bool mixes_maps(const Job& job);
/// What the job says, or `pixel` for several maps, else `vertex`.
[[nodiscard]] LookupPosition lookup_position(const Job& job);

} // namespace gnomon::scene
