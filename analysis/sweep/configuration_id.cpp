#include "analysis/sweep/configuration_id.hpp"

#include "analysis/results/results.hpp"
#include "scene/fnv1a.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::analysis {

std::string scene_in_ids(const SceneIdentity& scene, const JobParameters& given)
{
    if (!scene.hash.empty()) {
        return scene.name();
    }
    const auto file = std::find_if(given.begin(), given.end(), [](const auto& parameter) {
        return parameter.first == "scene.file";
    });
    return file == given.end() ? std::string{} : "unread " + file->second;
}

std::string configuration_id(std::string_view version, std::string_view scene_name,
                             const JobParameters& parameters, bool with_constant_bias)
{
    scene::Fnv1a hash;
    hash.add(fmt::format("schema {}", result_schema));
    hash.add(version);
    hash.add(scene_name);
    for (const auto& [key, value] : parameters) {
        // The file's place says nothing that the scene's name does not.
        if (key != "scene.file" && (with_constant_bias || !scene::is_constant_bias(key))) {
            hash.add(key);
            hash.add(value);
        }
    }
    return fmt::format("{:016x}", hash.value());
}

} // namespace gnomon::analysis
