#include "scene/load_scene.hpp"

#include "scene/builtin/scenes.hpp"
#include "scene/error.hpp"

namespace gnomon::scene {

SceneFile load_scene(const SceneSettings& settings, VertexNormals normals)
{
    if (settings.builtin.empty() == settings.file.empty()) {
        throw InputError(
            "a job needs exactly one of scene.builtin and scene.file: set one of them");
    }
    SceneFile loaded;
    if (!settings.builtin.empty()) {
        const BuiltinScene& builtin = find_builtin_scene(settings.builtin);
        loaded.scene = builtin.build(complete_parameters(builtin, settings.parameters));
    } else {
        loaded = load_scene_file(settings.file, {}, normals);
    }
    if (settings.ground) {
        add_ground(loaded.scene);
    }
    set_roles(loaded.scene, settings.no_cast, settings.no_receive);
    if (normals == VertexNormals::kept) {
        complete_vertex_normals(loaded.scene);
    }
    return loaded;
}

} // namespace gnomon::scene
