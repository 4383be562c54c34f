#include "scene/import/ignored_content.hpp"

#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::scene {
namespace {

/// How transparent a surface is, from glTF's alphaMode or another file's opacity.
struct Transparency {
    bool is_masked = false;
    bool is_blended = false;
    bool is_clear = false;
    bool has_vertex_alpha = false;
};

bool any_vertex_alpha(const aiMesh& mesh)
{
    if (!mesh.HasVertexColors(0)) {
        return false;
    }
    const std::span<const aiColor4D> colours{mesh.mColors[0], mesh.mNumVertices};
    return std::ranges::any_of(colours, [](const aiColor4D& colour) { return colour.a < 1; });
}

/// A glTF material defines what its alpha does; an opaque one ignores vertex alpha, too. An OBJ
/// material has an opacity and perhaps an opacity texture.
Transparency transparency(const aiMesh& mesh, const aiMaterial& material)
{
    float opacity = 1;
    material.Get(AI_MATKEY_OPACITY, opacity);
    aiString mode;
    if (material.Get("$mat.gltf.alphaMode", 0, 0, mode) == AI_SUCCESS) {
        const std::string_view name{mode.C_Str()};
        const bool is_masked = name == "MASK";
        const bool is_blended = name == "BLEND";
        return {is_masked, is_blended, (is_masked || is_blended) && opacity == 0, false};
    }
    return {material.GetTextureCount(aiTextureType_OPACITY) > 0, opacity < 1, opacity == 0,
            any_vertex_alpha(mesh)};
}

} // namespace

void SurfaceCounter::add(const aiMesh& mesh)
{
    objects_.skinned_objects += mesh.mNumBones > 0 ? 1U : 0U;
    objects_.morphed_objects += mesh.mNumAnimMeshes > 0 ? 1U : 0U;
    if (mesh.mMaterialIndex >= scene_->mNumMaterials) {
        return;
    }
    const unsigned material = mesh.mMaterialIndex;
    const Transparency found = transparency(mesh, *scene_->mMaterials[material]);
    objects_.vertex_alpha_objects += found.has_vertex_alpha ? 1U : 0U;
    if (found.is_masked) {
        ++objects_.masked_objects;
        masked_.insert(material);
    }
    if (found.is_blended) {
        ++objects_.blended_objects;
        blended_.insert(material);
    }
    if (found.is_clear) {
        clear_.insert(material);
    }
}

void SurfaceCounter::write(ContentCounts& counts) const
{
    counts.masked_materials = masked_.size();
    counts.masked_objects = objects_.masked_objects;
    counts.blended_materials = blended_.size();
    counts.blended_objects = objects_.blended_objects;
    counts.clear_materials = clear_.size();
    counts.vertex_alpha_objects = objects_.vertex_alpha_objects;
    counts.skinned_objects = objects_.skinned_objects;
    counts.morphed_objects = objects_.morphed_objects;
}

std::uint64_t count_free_form_shapes(const std::filesystem::path& obj_file)
{
    constexpr std::array<std::string_view, 3> statements{"surf", "curv", "curv2"};
    std::ifstream file{obj_file, std::ios::binary};
    std::uint64_t count = 0;
    std::string line;
    while (std::getline(file, line)) {
        const std::string_view statement =
            std::string_view{line}.substr(0, line.find_first_of(" \t"));
        count += std::ranges::find(statements, statement) != statements.end() ? 1U : 0U;
    }
    return count;
}

} // namespace gnomon::scene
