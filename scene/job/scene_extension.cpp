#include "scene/job/scene_extension.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace gnomon::scene {

bool is_scene_file(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array<std::string_view, 4> scene_extensions{".gltf", ".glb", ".obj", ".ply"};
    return std::find(scene_extensions.begin(), scene_extensions.end(), extension) !=
           scene_extensions.end();
}

} // namespace gnomon::scene
