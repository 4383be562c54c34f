#include "reports/gate/limited_text.hpp"

#include "scene/error.hpp"
#include "scene/job_toml.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace gnomon::reports {

std::string read_limited_text(const std::filesystem::path& path, std::uint64_t most_bytes,
                              const std::string& kind)
{
    const std::string name = scene::one_line(path.string());
    std::error_code unknown;
    if (std::filesystem::is_directory(path, unknown)) {
        throw scene::InputError(fmt::format("{}: is a folder: name a {}", name, kind));
    }
    errno = 0;
    std::ifstream file{path, std::ios::binary};
    if (!file) {
        throw scene::InputError(
            fmt::format("{}: cannot be opened: {}; check the path", name, std::strerror(errno)));
    }
    std::string text;
    std::array<char, 65536> block{};
    while (file.read(block.data(), block.size()) || file.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(file.gcount()));
        if (text.size() > most_bytes) {
            throw scene::InputError(fmt::format("{}: longer than {} MiB: this is no {}", name,
                                                most_bytes >> 20U, kind));
        }
    }
    if (file.bad()) {
        throw scene::InputError(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
    }
    return text;
}

} // namespace gnomon::reports
