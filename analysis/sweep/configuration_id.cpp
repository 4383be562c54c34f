#include "analysis/sweep/configuration_id.hpp"

#include "analysis/results/results.hpp"
#include "methods/job_method.hpp"
#include "scene/fnv1a.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

namespace {

/// The keys for camera and light that the job takes from the file.
std::string keys_taken(const scene::Job& job, const scene::SceneDefaults& defaults)
{
    scene::Job taking;
    taking.camera = job.camera ? std::nullopt : defaults.camera;
    taking.light = job.light ? std::nullopt : defaults.light;
    std::string text;
    for (const auto& [key, value] : scene::resolved_keys(taking)) {
        if (key.starts_with("camera.") || key.starts_with("light.")) {
            text += '\n';
            text += key;
            text += '=';
            text += value;
        }
    }
    return text;
}

} // namespace

SceneIdentity identify_scene(const scene::Job& job, std::string hash,
                             const scene::SceneDefaults& defaults, std::string_view normals)
{
    SceneIdentity identity{std::move(hash), keys_taken(job, defaults)};
    if (methods::vertex_normals(job) == scene::VertexNormals::kept) {
        identity.taken_keys += "\nscene.vertex_normals=";
        identity.taken_keys += normals;
    }
    return identity;
}

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
        // The file's path adds nothing to the scene's name.
        if (key != "scene.file" && (with_constant_bias || !scene::is_constant_bias(key))) {
            hash.add(key);
            hash.add(value);
        }
    }
    return fmt::format("{:016x}", hash.value());
}

} // namespace gnomon::analysis
