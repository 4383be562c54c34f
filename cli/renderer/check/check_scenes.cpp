#include "cli/renderer/check/renderer_check.hpp"

#include "analysis/comparison/comparison.hpp"
#include "methods/key_table.hpp"
#include "scene/load/load_scene.hpp"

#include <utility>

namespace gnomon::cli {
namespace {

std::vector<std::string> names_of(const scene::JobSource& source)
{
    std::vector<std::string> names;
    for (const auto& [key, value] : scene::given_keys(source)) {
        names.push_back(key);
    }
    return names;
}

scene::JobSource wall_source(const std::vector<scene::Override>& settings)
{
    std::vector<scene::Override> all{{"scene.wall.thickness_m", "0.4"},
                                     {"shadow_map.resolution", "256"},
                                     {"camera.up", "[0, 1, 0]"},
                                     {"camera.vertical_fov_deg", "50"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::builtin_job_source("wall", all, {}, methods::key_table());
}

} // namespace

CheckScene::CheckScene(const scene::JobSource& source)
    : source_{source},
      job_{scene::make_job(source)},
      file_{scene::load_scene(job_.scene)},
      view_{scene::resolve_view(job_, file_.scene, file_.defaults)},
      given_{names_of(source)}
{
}

RendererScene CheckScene::scene() const
{
    return {analysis::scene_name(job_.scene), file_.scene,
            scene::resolve_camera(job_, file_.scene, file_.defaults),
            scene::resolve_light(job_, file_.defaults), job_.image};
}

CheckScene CheckScene::with(const std::vector<scene::Override>& settings) const
{
    scene::JobSource source = source_;
    const scene::Layer layer = scene::layer_from_overrides(*source.keys, settings);
    source.overrides.insert(source.overrides.end(), layer.begin(), layer.end());
    return CheckScene{source};
}

std::string CheckScene::complaint(const RendererFrame& frame, const scene::CaseSpace& space) const
{
    const api::CaseMesh mesh{file_.scene, space, 0};
    const api::LoadedCase loaded{frame.file, frame.layers, mesh};
    const analysis::CheckedCase checked = loaded.check(std::nullopt);
    return checked.check.mistake.empty() ? checked.check.warning : checked.check.sentence;
}

std::vector<CheckScene> check_scenes()
{
    std::vector<CheckScene> scenes;
    scenes.emplace_back(wall_source({{"image.width", "64"},
                                     {"image.height", "48"},
                                     {"camera.eye", "[5, 4, 5]"},
                                     {"camera.target", "[1, 0.5, 0]"}}));
    scenes.emplace_back(wall_source({{"image.width", "48"},
                                     {"image.height", "40"},
                                     {"camera.eye", "[6, 3, -3]"},
                                     {"camera.target", "[0.5, 0.7, 0]"},
                                     {"light.type", "spot"},
                                     {"light.position", "[-3, 5, 1]"},
                                     {"light.target", "[0, 0, 0]"},
                                     {"light.cone_deg", "80"}}));
    scenes.emplace_back(wall_source({{"image.width", "64"},
                                     {"image.height", "48"},
                                     {"camera.eye", "[6, 4, 2]"},
                                     {"camera.target", "[0.5, 0.7, 0]"},
                                     {"light.type", "point"},
                                     {"light.position", "[-2, 4, -1]"}}));
    return scenes;
}

} // namespace gnomon::cli
