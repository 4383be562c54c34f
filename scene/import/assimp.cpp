#include "scene/import/assimp.hpp"

#include "scene/import/cameras_and_lights.hpp"
#include "scene/import/folder.hpp"
#include "scene/import/gltf_facts.hpp"
#include "scene/import/ignored_content.hpp"
#include "scene/import/mesh.hpp"
#include "scene/import/names.hpp"
#include "scene/import/ply.hpp"

#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

namespace {

/// Unregisters all other importers: a renamed file must not reach another format's parser.
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
        // Assimp passes on the what() of standard exceptions.
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

/// Checks the total size of all instances before anything is written.
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

/// The mesh's attributes, with unit normals in world space.
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
        // A matrix would spread NaN and infinity to the other coordinates. Unchanged, the error
        // message names the file's own coordinate.
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

/// Whether the file's name ends with one of the extensions.
bool is_named(const std::filesystem::path& scene_file, std::initializer_list<std::string_view> any)
{
    const std::string extension = lower_extension(scene_file);
    return std::ranges::find(any, extension) != any.end();
}

/// Facts read from the file itself, to detect what Assimp silently dropped.
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
    counts.cameras = count_cameras(scene, nodes);
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
    const std::optional<ImportedCamera> camera = find_camera(scene, nodes);
    header.has_camera = camera ? 1 : 0;
    header.camera = camera.value_or(ImportedCamera{});
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
