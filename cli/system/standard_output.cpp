#include "cli/system/standard_output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace gnomon::cli {

void print(std::string_view text)
{
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0) {
        if (errno == EPIPE) {
            throw BrokenPipe{};
        }
        throw scene::EnvironmentError(fmt::format(
            "standard output: {}: free space or write elsewhere", std::strerror(errno)));
    }
}

} // namespace gnomon::cli
