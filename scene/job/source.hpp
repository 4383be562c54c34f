#pragma once

#include "scene/job/keys/key_table.hpp"
#include "scene/job/presets/chosen_preset.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/settings/job.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

/// Where jobs come from: what one file or built-in, its cases, its sweep and the command line say,
/// not yet laid over each other.
struct JobSource {
    Keys keys = own_keys();          ///< the table it was read with
    std::string name;                ///< how messages speak of it
    std::filesystem::path folder;    ///< what a relative scene.file is relative to
    std::vector<std::string> lights; ///< names of the `[[lights]]`; empty: one light, `[light]`
    ChosenPreset preset;
    Layer scene_lights; ///< what lights are by themselves: those of the scene file, or of a choice
    Layer file;
    std::vector<CaseLayer> cases;
    Layer overrides;
    Sweep sweep;
};

/// @throws InputError  as `read_job` does, for everything but keys that do not go together.
/// @param preset  the name of a preset, which takes the place of the file's own; empty: none.
[[nodiscard]] JobSource read_job_source(const std::filesystem::path& path,
                                        const std::vector<Override>& overrides,
                                        std::string_view preset = {}, Keys keys = own_keys());
/// `read_job_source` of a file whose text is known already, as that of a planned sweep is.
/// @param path  where the file was: what it names is relative to its folder. Of a scene file,
///              which has no text, it is the scene itself.
/// @throws InputError  as `read_job_source`, but for reading the job file.
[[nodiscard]] JobSource job_source_of_text(const std::filesystem::path& path, std::string_view text,
                                           const std::vector<Override>& overrides,
                                           std::string_view preset = {}, Keys keys = own_keys());

[[nodiscard]] JobSource builtin_job_source(std::string_view name,
                                           const std::vector<Override>& overrides,
                                           std::string_view preset = {}, Keys keys = own_keys());
/// Of a preset with the scene that it has of its own.
[[nodiscard]] JobSource preset_job_source(std::string_view preset,
                                          const std::vector<Override>& overrides,
                                          Keys keys = own_keys());

/// The source of the job with a preset in place of what the file and the case say of method, map,
/// lookup and bias: their scene, camera, light and image stay, and where the map looks, and what
/// the overrides say.
/// @param chosen  The case; nullptr for none.
[[nodiscard]] JobSource with_preset(const JobSource& source, const CaseLayer* chosen,
                                    const Preset& preset);

/// @throws InputError  naming the nearest case.
[[nodiscard]] const CaseLayer& find_case(const JobSource& source, std::string_view name);

/// What one of several lights is told, as the source of a job with that light alone.
/// @throws InputError  if there is no such light.
[[nodiscard]] JobSource only_light(const JobSource& source, std::string_view light);

/// Lays the built-in's defaults, the preset, the file, the case, the overrides and a sweep's axes
/// over each other, in this order; each says first what holds for all lights, then what for one of
/// them. Of a built-in's system keys nothing is left under a preset (`is_system_key`), and a
/// preset's own scene holds where nothing over it names one.
/// @param chosen  The case; nullptr for none.
/// @param light   Which of several lights the job is of; empty: it has but one.
/// @throws InputError  if keys do not go together, or no light is named where there are several.
[[nodiscard]] Job make_job(const JobSource& source, const CaseLayer* chosen = nullptr,
                           const Layer& axes = {}, std::string_view light = {});

/// What the preset, the file, the case, the overrides and the axes say, whether it goes together or
/// not: keys and values as text, in the order of the table. A scene's file is as it was written.
[[nodiscard]] std::vector<std::pair<std::string, std::string>>
given_keys(const JobSource& source, const CaseLayer* chosen = nullptr, const Layer& axes = {},
           std::string_view light = {});

} // namespace gnomon::scene
