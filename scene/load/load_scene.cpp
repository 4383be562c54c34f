#include "scene/load/load_scene.hpp"

#include "scene/builtin/scenes.hpp"
#include "scene/error.hpp"
#include "scene/import/load_scene_file.hpp"

#include <utility>

namespace gnomon::scene {

SceneFile complete_scene(SceneFile loaded, const SceneSettings& settings, VertexNormals normals)
{
    if (settings.ground) {
        add_ground(loaded.scene);
    }
    set_roles(loaded.scene, settings.no_cast, settings.no_receive);
    if (normals == VertexNormals::kept) {
        complete_vertex_normals(loaded.scene);
    }
    return loaded;
}

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
        loaded = load_scene_file(settings.file, {}, normals, settings.file_space());
    }
    return complete_scene(std::move(loaded), settings, normals);
}

SealedBytes pack_scene(const SceneSettings& settings, VertexNormals normals)
{
    return pack_scene_file(settings.file, {}, normals);
}

SceneFile load_packed_scene(const SceneSettings& settings, std::span<const std::byte> packed,
                            VertexNormals normals)
{
    return complete_scene(unpack_scene_file(settings.file, packed, {}, settings.file_space()),
                          settings, normals);
}

} // namespace gnomon::scene
