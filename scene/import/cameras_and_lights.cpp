#include "scene/import/cameras_and_lights.hpp"

#include <assimp/Importer.hpp>
#include <assimp/camera.h>
#include <assimp/commonMetaData.h>
#include <assimp/light.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string_view>

namespace gnomon::scene {

namespace {

/// A camera of 1 rad and twice as wide as high.
constexpr std::string_view known_camera_of_gltf_1 =
    R"({"asset":{"version":"1.0"},"scene":"s","scenes":{"s":{"nodes":["n"]}},"nodes":{"n":{"camera":"c"}},)"
    R"("cameras":{"c":{"type":"perspective","perspective":{"yfov":1,"aspectRatio":2,"znear":1,"zfar":2}}}})";
constexpr std::string_view known_camera_of_gltf_2 =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"camera":0}],)"
    R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"aspectRatio":2,"znear":1,"zfar":2}}]})";

bool is_gltf_1(const aiScene& scene)
{
    aiString version;
    return scene.mMetaData != nullptr &&
           scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT_VERSION, version) &&
           std::string_view{version.C_Str()}.starts_with('1');
}

/// Whether the importer multiplies the tangent of half the angle by the aspect ratio, not the
/// angle.
bool multiplies_tangents(std::string_view known_camera)
{
    Assimp::Importer importer;
    const aiScene* const scene =
        importer.ReadFileFromMemory(known_camera.data(), known_camera.size(), 0, "gltf");
    if (scene == nullptr || scene->mNumCameras != 1) {
        throw std::runtime_error{
            "its camera's angle is unknown: Assimp does not read a known camera"};
    }
    constexpr float between = 1.8F; // 2 rad by angles, 1.66 rad by tangents
    return scene->mCameras[0]->mHorizontalFOV < between;
}

std::span<const aiCamera* const> cameras_of(const aiScene& scene)
{
    return {scene.mCameras, scene.mNumCameras};
}

Vec3d axis(const PlacedNode& node, int column)
{
    return Vec3d{node.world_from_node[column]};
}

/// Cameras and lights stand at the node with their name.
template <typename Item>
bool stands_at(const Item& item, const PlacedNode& node)
{
    return item.mName.length > 0 && item.mName == node.node->mName;
}

/// The vertical field of view of a glTF camera [rad]; 0 if it is orthographic.
///
/// Assimp stores a horizontal angle, and its importers compute it differently: yfov · aspect ratio
/// (5.2), or 2·atan(tan(yfov / 2) · aspect ratio) (5.4, for glTF 2). A camera with a known angle
/// shows which one the linked importer uses.
/// @throws std::runtime_error  if it does not read the known camera.
double vertical_fov_rad(const aiCamera& camera, const aiScene& scene)
{
    const auto horizontal_rad = static_cast<double>(camera.mHorizontalFOV);
    const auto aspect = static_cast<double>(camera.mAspect);
    if (aspect == 0 || horizontal_rad == 0) {
        return horizontal_rad;
    }
    bool by_tangents = false;
    if (is_gltf_1(scene)) {
        static const bool is_so = multiplies_tangents(known_camera_of_gltf_1);
        by_tangents = is_so;
    } else {
        static const bool is_so = multiplies_tangents(known_camera_of_gltf_2);
        by_tangents = is_so;
    }
    if (by_tangents) {
        return 2 * std::atan(std::tan(0.5 * horizontal_rad) / aspect);
    }
    return horizontal_rad / aspect;
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

/// Empty for spots of 180 degrees or more: one camera cannot cover them.
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

/// Assimp adds a root node above several roots of the file.
std::size_t added_roots(const GltfFacts& gltf)
{
    return gltf.root_count == 1 ? 0 : 1;
}

/// Reads lights from the file's JSON. Precondition: Assimp's nodes match the JSON's.
std::vector<NamedLight> lights_of_gltf(const GltfFacts& gltf, const std::vector<PlacedNode>& nodes)
{
    const std::size_t added = added_roots(gltf);
    std::vector<NamedLight> lights;
    for (const GltfLight& light : gltf.lights) {
        lights.push_back({light_at(light, nodes[light.node + added]), light.name});
    }
    return lights;
}

} // namespace

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

std::optional<ImportedCamera> find_camera(const aiScene& scene,
                                          const std::vector<PlacedNode>& nodes)
{
    for (const PlacedNode& node : nodes) {
        for (const aiCamera* camera : cameras_of(scene)) {
            const auto found =
                stands_at(*camera, node) ? camera_at(*camera, scene, node) : std::nullopt;
            if (found) {
                return found;
            }
        }
    }
    return std::nullopt;
}

std::uint64_t count_cameras(const aiScene& scene, const std::vector<PlacedNode>& nodes)
{
    std::uint64_t count = 0;
    for (const PlacedNode& node : nodes) {
        count += static_cast<std::uint64_t>(std::ranges::count_if(
            cameras_of(scene), [&](const aiCamera* camera) { return stands_at(*camera, node); }));
    }
    return count;
}

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

} // namespace gnomon::scene
