#include "scene/import/free_form_shapes.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>

namespace gnomon::scene {

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
