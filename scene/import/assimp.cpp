#include "scene/import/assimp.hpp"

#include "scene/import/field_of_view.hpp"
#include "scene/import/folder.hpp"
#include "scene/import/free_form_shapes.hpp"
#include "scene/import/gltf_facts.hpp"
#include "scene/import/mesh.hpp"
#include "scene/import/names.hpp"
#include "scene/import/ply.hpp"
#include "scene/import/surface.hpp"

#include <assimp/Importer.hpp>
#include <assimp/camera.h>
#include <assimp/importerdesc.h>
#include <assimp/light.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <new>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

namespace {

/// A node of the flattened tree.
struct PlacedNode {
    const aiNode* node = nullptr;
    Mat4d world_from_node;
};

/// Only what is left after these is read: a renamed file must not reach another format's parser.
void keep_known_formats(Assimp::Importer& importer)
{
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        if (!reads_known_format(importer.GetImporterInfo(i)->mFileExtensions)) {
            importer.UnregisterLoader(importer.GetImporter(i));
        }
    }
}

const aiScene& read(Assimp::Importer& importer, const std::string& path)
{
    // No post-processing: the importer's own triangulation folds concave polygons over.
    const aiScene* scene = importer.ReadFile(path, 0);
    if (scene == nullptr) {
        // The library passes on what the standard library's exceptions call themselves.
        const std::string reason = importer.GetErrorString();
        if (reason.starts_with("std::bad_") || reason.starts_with("vector::")) {
            throw std::bad_alloc{};
        }
        throw std::runtime_error{reason};
    }
    if (scene->mRootNode == nullptr) {
        throw std::runtime_error{"the file has no scene"};
    }
    return *scene;
}

/// Every node, parents before children, children in order.
std::vector<PlacedNode> placed_nodes(const aiNode& root)
{
    std::vector<PlacedNode> open{{&root, Mat4d{1}}};
    std::vector<PlacedNode> placed;
    while (!open.empty()) {
        PlacedNode next = open.back();
        open.pop_back();
        const aiMatrix4x4& m = next.node->mTransformation;
        const Mat4d parent_from_node{m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2,
                                     m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
        next.world_from_node = next.world_from_node * parent_from_node;
        placed.push_back(next);
        for (unsigned c = next.node->mNumChildren; c-- > 0;) {
            open.push_back({next.node->mChildren[c], next.world_from_node});
        }
    }
    return placed;
}

Vec3d axis(const PlacedNode& node, int column)
{
    return Vec3d{node.world_from_node[column]};
}

/// Cameras and lights stand at the node that bears their name.
template <typename Item>
bool stands_at(const Item& item, const PlacedNode& node)
{
    return item.mName.length > 0 && item.mName == node.node->mName;
}

std::optional<ImportedCamera> camera_at(const aiCamera& camera, const aiScene& scene,
                                        const PlacedNode& node)
{
    const double aspect = camera.mAspect == 0.0F ? 1.0 : static_cast<double>(camera.mAspect);
    ImportedCamera result{axis(node, 3), -axis(node, 2), axis(node, 1)};
    result.vertical_fov_rad = vertical_fov_rad(camera, scene);
    result.orthographic_height_m = 2.0 * static_cast<double>(camera.mOrthographicWidth) / aspect;
    const bool is_usable = result.vertical_fov_rad > 0
                               ? result.vertical_fov_rad < std::numbers::pi
                               : result.vertical_fov_rad == 0 && result.orthographic_height_m > 0 &&
                                     std::isfinite(result.orthographic_height_m);
    return is_usable ? std::optional{result} : std::nullopt;
}

/// A spot without a shadow map of one camera, of 180 degrees and more, is none.
std::optional<ImportedLight> spot_at(float outer_cone_rad, const PlacedNode& node)
{
    ImportedLight result{axis(node, 3), -axis(node, 2)};
    result.outer_cone_rad = static_cast<double>(outer_cone_rad);
    const bool is_usable =
        result.outer_cone_rad > 0 && outer_cone_rad < std::numbers::pi_v<float> / 2;
    return is_usable ? std::optional{result} : std::nullopt;
}

std::optional<ImportedLight> light_at(const aiLight& light, const PlacedNode& node)
{
    ImportedLight result{axis(node, 3), -axis(node, 2)};
    if (light.mType == aiLightSource_DIRECTIONAL) {
        return result;
    }
    if (light.mType == aiLightSource_POINT) {
        result.is_point = 1;
        return result;
    }
    return light.mType == aiLightSource_SPOT ? spot_at(light.mAngleOuterCone, node) : std::nullopt;
}

std::optional<ImportedLight> light_at(const GltfLight& light, const PlacedNode& node)
{
    ImportedLight result{axis(node, 3), -axis(node, 2)};
    if (light.type == "spot") {
        return spot_at(light.outer_cone_rad, node);
    }
    result.is_point = light.type == "point" ? 1 : 0;
    return light.type == "point" || light.type == "directional" ? std::optional{result}
                                                                : std::nullopt;
}

void find_camera(const aiScene& scene, const std::vector<PlacedNode>& nodes, ImportHeader& header)
{
    for (const PlacedNode& node : nodes) {
        for (unsigned c = 0; c < scene.mNumCameras && header.has_camera == 0; ++c) {
            if (stands_at(*scene.mCameras[c], node)) {
                const auto camera = camera_at(*scene.mCameras[c], scene, node);
                header.has_camera = camera ? 1 : 0;
                header.camera = camera.value_or(ImportedCamera{});
            }
        }
    }
}

/// A light of the scene; empty if no shadow map may be of it.
struct NamedLight {
    std::optional<ImportedLight> light;
    std::string name;
};

/// Assimp's own root above several of the file's.
std::size_t added_roots(const GltfFacts& gltf)
{
    return gltf.root_count == 1 ? 0 : 1;
}

/// By the file's own JSON, of whose nodes Assimp's are known to be the same.
std::vector<NamedLight> lights_of_gltf(const GltfFacts& gltf, const std::vector<PlacedNode>& nodes)
{
    const std::size_t added = added_roots(gltf);
    std::vector<NamedLight> lights;
    for (const GltfLight& light : gltf.lights) {
        lights.push_back({light_at(light, nodes[light.node + added]), light.name});
    }
    return lights;
}

/// In the order of their nodes.
std::vector<NamedLight> find_lights(const aiScene& scene, const std::vector<PlacedNode>& nodes,
                                    const GltfFacts& gltf)
{
    if (!gltf.lights.empty() && nodes.size() == gltf.node_count + added_roots(gltf)) {
        return lights_of_gltf(gltf, nodes);
    }
    std::vector<NamedLight> lights;
    for (const PlacedNode& node : nodes) {
        for (unsigned l = 0; l < scene.mNumLights; ++l) {
            if (stands_at(*scene.mLights[l], node)) {
                lights.push_back({light_at(*scene.mLights[l], node), node.node->mName.C_Str()});
            }
        }
    }
    return lights;
}

void write_light(const NamedLight& light, ImportWriter& writer)
{
    ImportedLight imported = *light.light;
    imported.name_bytes = light.name.size();
    writer.put(imported);
    writer.put_array(std::span<const char>{light.name});
}

/// One mesh at one node.
struct Instance {
    const PlacedNode* node = nullptr;
    const ImportedMesh* mesh = nullptr;
    const aiMesh* source = nullptr;
    std::string name;
};

std::string instance_name(const aiNode& node, unsigned k, const aiMesh& mesh)
{
    const std::string node_name = node.mName.C_Str();
    const std::string mesh_name = mesh.mName.C_Str();
    if (node.mNumMeshes == 1 || node_name.empty()) {
        return node_name.empty() ? mesh_name : node_name;
    }
    return node_name + "/" + (mesh_name.empty() ? std::to_string(k + 1) : mesh_name);
}

std::vector<Instance> instances(const aiScene& scene, const std::vector<PlacedNode>& nodes,
                                const std::vector<ImportedMesh>& meshes)
{
    std::vector<Instance> result;
    for (const PlacedNode& placed : nodes) {
        const aiNode& node = *placed.node;
        for (unsigned k = 0; k < node.mNumMeshes; ++k) {
            const ImportedMesh& mesh = meshes.at(node.mMeshes[k]);
            if (!mesh.triangles.empty()) {
                const aiMesh& source = *scene.mMeshes[node.mMeshes[k]];
                result.push_back({&placed, &mesh, &source, instance_name(node, k, source)});
            }
        }
    }
    return result;
}

/// Before anything is written: what the instances come to, all together.
void check_size(const std::vector<Instance>& all, const ImportLimits& limits)
{
    std::uint64_t triangles = 0;
    std::uint64_t bytes = 0;
    for (const Instance& instance : all) {
        triangles += instance.mesh->triangles.size();
        bytes += instance.mesh->vertices.size() * sizeof(Vec3d) +
                 instance.mesh->triangles.size() * sizeof(TriangleIndices) +
                 instance.mesh->attributes.size() * sizeof(TriangleAttributes);
        if (triangles > limits.triangles || bytes > limits.memory_bytes) {
            throw std::runtime_error{
                fmt::format("more than {} triangles or {} MiB once its instances are flattened",
                            limits.triangles, limits.memory_bytes >> 20U)};
        }
    }
}

/// The file's, with normals that are unit in the world.
std::vector<TriangleAttributes> world_attributes(const ImportedMesh& mesh, const glm::dmat3& world)
{
    std::vector<TriangleAttributes> attributes = mesh.attributes;
    for (TriangleAttributes& corners : attributes) {
        for (CornerAttributes& corner : corners) {
            corner.normal = moved_normal(world, Vec3d{corner.normal});
        }
    }
    return attributes;
}

void write_instance(const Instance& instance, ImportWriter& writer)
{
    const Mat4d& world = instance.node->world_from_node;
    std::vector<Vec3d> vertices;
    vertices.reserve(instance.mesh->vertices.size());
    for (const Vec3f& vertex : instance.mesh->vertices) {
        const Vec3d local{vertex};
        // A matrix would spread what is not finite over the other coordinates; as it is, the
        // coordinate that is refused is the file's.
        const bool is_finite =
            std::isfinite(local.x) && std::isfinite(local.y) && std::isfinite(local.z);
        vertices.push_back(is_finite ? Vec3d{world * Vec4d{local, 1.0}} : local);
    }
    std::vector<TriangleIndices> triangles = instance.mesh->triangles;
    auto attributes = world_attributes(*instance.mesh, glm::dmat3{world});
    if (glm::determinant(glm::dmat3{world}) < 0) {
        // A mirrored instance keeps its front faces in front.
        for (TriangleIndices& triangle : triangles) {
            std::swap(triangle[1], triangle[2]);
        }
        for (TriangleAttributes& corners : attributes) {
            std::swap(corners[1], corners[2]);
        }
    }
    writer.put(ImportedObject{instance.name.size(), vertices.size(), triangles.size(),
                              3 * attributes.size()});
    writer.put_array(std::span<const char>{instance.name});
    writer.put_array(std::span<const Vec3d>{vertices});
    writer.put_array(std::span<const TriangleIndices>{triangles});
    writer.put_array(std::span<const TriangleAttributes>{attributes});
}

/// The format, by what the file's name ends with.
bool is_named(const std::filesystem::path& scene_file, std::initializer_list<std::string_view> any)
{
    const std::string extension = lower_extension(scene_file);
    return std::ranges::find(any, extension) != any.end();
}

/// What the file says of itself, where Assimp keeps silent about what it lost.
struct FileFacts {
    GltfFacts gltf;
    std::uint64_t free_form_shapes = 0;
};

FileFacts read_file_facts(const std::filesystem::path& scene_file)
{
    FileFacts facts;
    if (is_named(scene_file, {".gltf", ".glb"})) {
        facts.gltf = read_gltf_facts(scene_file);
    } else if (is_named(scene_file, {".obj"})) {
        facts.free_form_shapes = count_free_form_shapes(scene_file);
    }
    return facts;
}

void count_placed(const aiScene& scene, const std::vector<PlacedNode>& nodes,
                  const std::vector<Instance>& all, ContentCounts& counts)
{
    for (const PlacedNode& node : nodes) {
        for (unsigned c = 0; c < scene.mNumCameras; ++c) {
            counts.cameras += stands_at(*scene.mCameras[c], node) ? 1U : 0U;
        }
    }
    SurfaceCounter surfaces{scene};
    for (const Instance& instance : all) {
        surfaces.add(*instance.source);
    }
    surfaces.write(counts);
    counts.animations = scene.mNumAnimations;
}

void write_scene(const aiScene& scene, const FileFacts& facts, const ImportLimits& limits,
                 VertexNormals normals, int output)
{
    const std::vector<PlacedNode> nodes = placed_nodes(*scene.mRootNode);
    ImportHeader header;
    find_camera(scene, nodes, header);
    std::vector<NamedLight> lights = find_lights(scene, nodes, facts.gltf);
    header.contents.lights = lights.size();
    std::erase_if(lights, [](const NamedLight& light) { return !light.light; });
    header.light_count = lights.size();
    std::vector<ImportedMesh> meshes;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        meshes.push_back(imported_mesh(*scene.mMeshes[m], normals));
        header.ignored_primitives += meshes.back().ignored_primitives;
    }
    const std::vector<Instance> all = instances(scene, nodes, meshes);
    check_size(all, limits);
    header.object_count = all.size();
    count_placed(scene, nodes, all, header.contents);
    header.contents.free_form_shapes = facts.free_form_shapes;
    std::string extensions;
    for (const std::string& extension : facts.gltf.unread_extensions) {
        extensions += extension + '\n';
    }
    header.extension_bytes = extensions.size();
    ImportWriter writer{output};
    writer.put(header);
    writer.put_array(std::span<const char>{extensions});
    for (const NamedLight& light : lights) {
        write_light(light, writer);
    }
    for (const Instance& instance : all) {
        write_instance(instance, writer);
    }
    writer.flush();
}

void write_refusal(const std::string& reason, int output,
                   ImportOutcome outcome = ImportOutcome::refusal)
{
    ImportWriter writer{output};
    ImportHeader header;
    header.outcome = outcome;
    writer.put(header);
    writer.put_array(std::span<const char>{reason});
    writer.flush();
}

} // namespace

bool reads_known_format(std::string_view extensions)
{
    while (!extensions.empty()) {
        const std::string_view extension = extensions.substr(0, extensions.find(' '));
        if (extension == "gltf" || extension == "glb" || extension == "obj" || extension == "ply") {
            return true;
        }
        extensions.remove_prefix(std::min(extension.size() + 1, extensions.size()));
    }
    return false;
}

void write_imported_scene(const std::filesystem::path& scene_file, const ImportLimits& limits,
                          VertexNormals normals, ImportAllowance& allowance, int output)
{
    Assimp::Importer importer;
    auto* folder =
        new ImportFolder{scene_file, [&](std::uint64_t bytes) { allowance.add_file(bytes); }};
    importer.SetIOHandler(folder); // takes ownership
    keep_known_formats(importer);
    try {
        const FileFacts facts = read_file_facts(scene_file);
        const bool is_ply = is_named(scene_file, {".ply"});
        if (is_ply) {
            require_whole_ply(scene_file);
            folder->replace_head(head_for_assimp(scene_file));
        }
        const aiScene& scene = read(importer, scene_file.string());
        require_triangles(facts.gltf, scene);
        if (is_ply) {
            require_ply_faces(scene_file, scene);
        }
        write_scene(scene, facts, limits, normals, output);
    } catch (const UnsupportedContent& content) {
        write_refusal(content.what(), output, ImportOutcome::unsupported);
    } catch (const std::bad_alloc&) {
        write_refusal("it needs more memory than a file of its size should", output);
    } catch (const std::exception& error) {
        const std::string& name = folder->refused_name();
        write_refusal(name.empty()
                          ? error.what()
                          : fmt::format("it refers to \"{}\", outside its own folder", name),
                      output);
    }
}

} // namespace gnomon::scene
