#include "cli/units/packed_scenes.hpp"

#include "analysis/sweep/stage_keys.hpp"
#include "scene/error.hpp"
#include "scene/load/load_scene.hpp"
#include "scene/load/packed_scene.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <ios>
#include <string>
#include <system_error>
#include <vector>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;
using store::PlannedScene;
using store::UnitPlan;

/// Not bad input: whatever was packed was read before.
[[noreturn]] void throw_damaged(const fs::path& packed)
{
    throw scene::EnvironmentError(scene::one_line(
        fmt::format("{}: the packed scene is damaged, or of another version; remove it, and bring "
                    "it anew",
                    packed.string())));
}

/// @throws scene::EnvironmentError  if it cannot be read.
std::vector<std::byte> bytes_of(const fs::path& path)
{
    std::error_code error;
    const auto size = fs::file_size(path, error);
    std::ifstream file{path, std::ios::binary};
    std::vector<std::byte> bytes(error ? 0 : size);
    if (error || !file.read(reinterpret_cast<char*>(bytes.data()),
                            static_cast<std::streamsize>(bytes.size()))) {
        throw_damaged(path);
    }
    return bytes;
}

/// Others are made wherever they are needed.
bool is_scene_of_file(const PlannedScene& scene)
{
    return scene.keys.find("scene.file") != std::string::npos;
}

bool is_packed(const fs::path& folder, const PlannedScene& scene)
{
    std::error_code error;
    return !folder.empty() && fs::exists(packed_scene_path(folder, scene), error);
}

} // namespace

fs::path packed_scene_path(const fs::path& folder, const PlannedScene& scene)
{
    return folder / fmt::format("{}-{}.scene", scene.hash, scene.brought);
}

bool has_packed_scenes(const fs::path& folder, const UnitPlan& plan, const store::PlannedUnit& unit)
{
    return std::ranges::all_of(plan.scenes, [&](const PlannedScene& scene) {
        return !is_scene_of_file(scene) ||
               std::ranges::find(unit.scenes, scene.hash) == unit.scenes.end() ||
               is_packed(folder, scene);
    });
}

scene::SceneFile load_planned_scene(const fs::path& folder, const UnitPlan& plan,
                                    const scene::Job& job, scene::VertexNormals normals)
{
    const auto planned =
        std::ranges::find(plan.scenes, analysis::stage_keys(job).scene, &PlannedScene::keys);
    if (planned == plan.scenes.end() || !is_packed(folder, *planned)) {
        return scene::load_scene(job.scene, normals);
    }
    const fs::path packed = packed_scene_path(folder, *planned);
    try {
        return scene::load_packed_scene(job.scene, bytes_of(packed), normals);
    } catch (const scene::InputError&) {
        throw_damaged(packed);
    }
}

} // namespace gnomon::cli
