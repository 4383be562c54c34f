#include "analysis/sweep/scene_identity.hpp"

#include "methods/job_method.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"

#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

namespace {

/// The keys that would make the job's own what it leaves to the file.
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

} // namespace gnomon::analysis
