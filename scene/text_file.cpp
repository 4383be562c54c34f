#include "scene/text_file.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace gnomon::scene {

std::string read_text_file(const std::filesystem::path& path, const std::string& name,
                           const std::string& kind, std::uint64_t most_bytes)
{
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        throw InputError(fmt::format("{}: is a folder; name a {} in it", name, kind));
    }
    errno = 0;
    std::ifstream file{path, std::ios::binary};
    if (!file) {
        throw InputError(
            fmt::format("{}: cannot be opened: {}; check the path", name, std::strerror(errno)));
    }
    std::string text;
    std::array<char, 65536> block{};
    while (file.read(block.data(), block.size()) || file.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(file.gcount()));
        if (text.size() > most_bytes) {
            throw InputError(fmt::format("{}: longer than {} MiB: this is no {}", name,
                                         most_bytes >> 20U, kind));
        }
    }
    if (file.bad()) {
        throw InputError(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
    }
    return text;
}

} // namespace gnomon::scene
