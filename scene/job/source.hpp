#pragma once

#include "scene/job/keys/key_table.hpp"
#include "scene/job/presets/presets.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/settings/job.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

/// The layers that make up jobs, not yet merged: a file or built-in, its cases, its sweep and the
/// command line.
struct JobSource {
    Keys keys = own_keys();          ///< the table it was read with
    std::string name;                ///< its name in messages
    std::filesystem::path folder;    ///< base of a relative scene.file
    std::vector<std::string> lights; ///< names of the `[[lights]]`; empty: one light, `[light]`
    ChosenPreset preset;
    Layer scene_lights; ///< initial settings of lights from the scene file or a chosen light
    Layer file;
    std::vector<CaseLayer> cases;
    Layer overrides;
    Sweep sweep;
};

/// @throws InputError  as `read_job`, except for incompatible keys.
/// @param preset  the name of a preset that replaces the file's own; may be empty.
[[nodiscard]] JobSource read_job_source(const std::filesystem::path& path,
                                        const std::vector<Override>& overrides,
                                        std::string_view preset = {}, Keys keys = own_keys());
/// `read_job_source` for a text that is already known, as in a planned sweep.
/// @param path  where the file was; its folder is the base of relative paths. For a scene file,
///              which has no text, the scene itself.
/// @throws InputError  as `read_job_source`, except for reading the job file.
[[nodiscard]] JobSource job_source_of_text(const std::filesystem::path& path, std::string_view text,
                                           const std::vector<Override>& overrides,
                                           std::string_view preset = {}, Keys keys = own_keys());

[[nodiscard]] JobSource builtin_job_source(std::string_view name,
                                           const std::vector<Override>& overrides,
                                           std::string_view preset = {}, Keys keys = own_keys());
/// The source of a preset with its own scene.
[[nodiscard]] JobSource preset_job_source(std::string_view preset,
                                          const std::vector<Override>& overrides,
                                          Keys keys = own_keys());

/// The source with a preset instead of the file's and case's method, map, lookup and bias. Keeps
/// their scene, camera, light, image and map placement, and all overrides.
/// @param chosen  The case, or nullptr.
[[nodiscard]] JobSource with_preset(const JobSource& source, const CaseLayer* chosen,
                                    const Preset& preset);

/// @throws InputError  naming the nearest case.
[[nodiscard]] const CaseLayer& find_case(const JobSource& source, std::string_view name);

/// The source of a job with only one of several lights.
/// @throws InputError  if the job has no such light.
[[nodiscard]] JobSource only_light(const JobSource& source, std::string_view light);

/// Merges the built-in's defaults, the preset, the file, the case, the overrides and a sweep's
/// axes, in this order; in each, settings for one light follow those for all. A preset drops the
/// built-in's system keys (`is_system_key`). Its own scene applies unless a later layer names one.
/// @param chosen  The case, or nullptr.
/// @param light   The light to use if there are several; else empty.
/// @throws InputError  if keys are incompatible, or `light` is empty and there are several.
[[nodiscard]] Job make_job(const JobSource& source, const CaseLayer* chosen = nullptr,
                           const Layer& axes = {}, std::string_view light = {});

/// The settings of preset, file, case, overrides and axes, compatible or not: keys and values as
/// text, in the order of the table. A scene.file is as written in the job.
[[nodiscard]] std::vector<std::pair<std::string, std::string>>
given_keys(const JobSource& source, const CaseLayer* chosen = nullptr, const Layer& axes = {},
           std::string_view light = {});

} // namespace gnomon::scene
