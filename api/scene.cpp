#include "api/scene.hpp"

#include "scene/load/load_scene.hpp"

#include <utility>

namespace gnomon::api {

Scene::Scene(const scene::SceneSettings& settings)
    : file_{scene::load_scene(settings)},
      north_{settings.north.value_or(scene::usual_north)}
{
}

Scene::Scene(scene::TriangleScene triangles) : file_{std::move(triangles), {}} {}

const reference_rt::ReferenceScene& Scene::reference() const
{
    std::call_once(reference_made_, [&] {
        reference_ = std::make_unique<const reference_rt::ReferenceScene>(file_.scene);
    });
    return *reference_;
}

} // namespace gnomon::api
