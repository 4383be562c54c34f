#include "scene/import/field_of_view.hpp"

#include <assimp/Importer.hpp>
#include <assimp/commonMetaData.h>

#include <cmath>
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

/// Whether the importer multiplies the tangent of half the angle, and not the angle, by the aspect
/// ratio.
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

} // namespace

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

} // namespace gnomon::scene
