#pragma once

#include "scene/job/value.hpp"
#include "scene/light/light.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

struct Job;
struct MethodSettings;

/// A stage of the computation. Each key names the stages that depend on it, so that a sweep knows
/// which results it can reuse.
enum class Stage : std::uint8_t {
    scene = 1 << 0,      ///< triangles
    truth = 1 << 1,      ///< classes
    receivers = 1 << 2,  ///< camera pass; with lookup.position = "vertex" light clip coordinates
    shadow_map = 1 << 3, ///< the map
    prefilter = 1 << 4,  ///< a method's filtering of the map before lookups
    lookup = 1 << 5,     ///< r, d
    bias = 1 << 6,       ///< verdicts only: answered by the bias curve
};
using Stages = std::uint8_t;

[[nodiscard]] constexpr Stages operator|(Stage a, Stage b)
{
    return static_cast<Stages>(static_cast<Stages>(a) | static_cast<Stages>(b));
}
[[nodiscard]] constexpr Stages operator|(Stages a, Stage b)
{
    return static_cast<Stages>(a | static_cast<Stages>(b));
}
[[nodiscard]] constexpr Stages only(Stage stage)
{
    return static_cast<Stages>(stage);
}

/// The unit of the numbers in `TriedValues`.
enum class TriedUnit : std::uint8_t {
    of_key,          ///< the key's own unit
    scene_diagonals, ///< of a key in metres: diagonals of the scene's bounding box
    texel_widths,    ///< of a key in metres: widths of a texel at the median receiver
};

/// Values that a settings search tries in addition to the key's default and the job's value.
struct TriedValues {
    std::vector<JobValue> values = {};
    TriedUnit unit = TriedUnit::of_key; ///< of values that are numbers
};

/// A key of the job file: its meaning, its domain, the stages that depend on it, and its place in a
/// job.
///
/// Keys of the layer `scene` live in members of `Job`. Higher layers add keys that live in
/// `MethodSettings::values` (`added_key`): "method.KEY" of a shadow method, "bias.KEY" of a bias
/// term, or "engine.KEY" of another renderer.
struct Key {
    std::string name;         ///< "shadow_map.resolution"
    std::string description;  ///< one line, with unit
    std::string unit;         ///< "m", "depth units"; empty: none
    std::string default_text; ///< as written in TOML, e.g. "1024" or "\"d24\""
    std::string range_text;   ///< e.g. "an integer from 1 to 16384"
    Stages stages = 0;        ///< the first stages to redo when it changes
    Domain domain = {};
    std::function<void(Job&, const JobValue&)> set = {};
    /// Empty if the job omits the key, as when the scene decides the camera.
    std::function<std::optional<JobValue>(const Job&)> get = {};
    std::string example = {};                   ///< a value to show for a key without a default
    std::optional<JobValue> default_value = {}; ///< of an added key; else empty
    TriedValues tried = {};                     ///< empty: a search does not vary the key
    std::optional<std::vector<std::string>> methods = {}; ///< that have the key; empty: all
    std::vector<LightType> lights = {};                   ///< that have the key; empty: all

    /// "bias" of "bias.constant".
    [[nodiscard]] std::string_view table() const;
    [[nodiscard]] bool is_added() const { return default_value.has_value(); }
    /// Whether the method of that name has it.
    [[nodiscard]] bool is_of(std::string_view method) const;
    [[nodiscard]] bool is_of(LightType light) const;
    /// The value of an added key in a job with these settings, or else the default.
    [[nodiscard]] const JobValue& value_of(const MethodSettings& method) const;
};

/// The last part of a dotted key.
[[nodiscard]] std::string_view key_leaf(std::string_view name);

/// A key without a domain and without a place in a job.
/// @param description  `{unit}` in it is replaced by the unit.
[[nodiscard]] Key make_key(std::string name, std::string description, std::string default_text,
                           Stages stages, std::string unit = {});

/// A key that a higher layer adds to a table.
/// @param key      from `make_key`, without its default.
/// @param methods  that have it; filled in by the table of all methods.
[[nodiscard]] Key added_key(Key key, Domain domain, JobValue default_value, TriedValues tried = {},
                            std::vector<std::string> methods = {});

} // namespace gnomon::scene
