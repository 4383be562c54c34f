#pragma once

#include "analysis/presets/preset_result.hpp"
#include "methods/method.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/presets/presets.hpp"

#include <span>
#include <string>

/// The outputs of `gnomon methods`, `scenes` and `presets`, as text and as JSON.
namespace gnomon::reports {

/// The methods with their lookup traits for each filter, bias terms and keys, as aligned text.
[[nodiscard]] std::string methods_table(std::span<const methods::Method> methods);
/// The methods as a JSON array: sources, keys, bias terms and lookup traits.
[[nodiscard]] std::string methods_json(std::span<const methods::Method> methods);

/// The built-in scenes and their parameters as aligned text.
[[nodiscard]] std::string scenes_table(std::span<const scene::BuiltinScene> scenes);
/// The built-in scenes as a JSON array. A parameter has a name, description, unit, default, and
/// its range or its allowed words.
[[nodiscard]] std::string scenes_json(std::span<const scene::BuiltinScene> scenes);

[[nodiscard]] std::string presets_table(std::span<const scene::Preset> presets);
/// The presets as a JSON array (docs/json_schema.md).
[[nodiscard]] std::string presets_json(std::span<const scene::Preset> presets);

/// The output of `gnomon presets --compare JOB`.
[[nodiscard]] std::string preset_comparison_table(const analysis::PresetComparison& comparison);
[[nodiscard]] std::string preset_comparison_json(const analysis::PresetComparison& comparison);

} // namespace gnomon::reports
