#include "scene/import_text.hpp"

#include "scene/import_gltf.hpp"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace gnomon::scene {

namespace {

/// A PLY file's header lines are short; what is longer is none.
constexpr std::size_t longest_header_line = 4096;

/// How many of an element the header announces.
std::uint64_t announced(const std::filesystem::path& ply_file, std::string_view element)
{
    std::ifstream file{ply_file, std::ios::binary};
    std::string line(longest_header_line, '\0');
    while (file.getline(line.data(), static_cast<std::streamsize>(line.size()))) {
        std::istringstream words{line.c_str()};
        std::string word;
        std::string name;
        std::uint64_t count = 0;
        words >> word >> name >> count;
        if (word == "end_header") {
            break;
        }
        if (word == "element" && name == element) {
            return count;
        }
    }
    return 0;
}

} // namespace

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

void require_faces(const std::filesystem::path& ply_file, const aiScene& scene)
{
    if (announced(ply_file, "tristrips") > 0) {
        throw UnsupportedContent{"it has triangle strips (element tristrips), which are not read; "
                                 "export faces instead"};
    }
    std::uint64_t read = 0;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        read += scene.mMeshes[m]->mNumFaces;
    }
    const std::uint64_t faces = announced(ply_file, "face");
    if (read < faces) {
        throw std::runtime_error{
            fmt::format("{} of its {} faces could not be read", faces - read, faces)};
    }
}

} // namespace gnomon::scene
