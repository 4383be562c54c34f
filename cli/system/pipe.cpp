#include "cli/system/pipe.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace gnomon::cli {

Pipe::Pipe()
{
    require_call(::pipe2(ends_.data(), O_CLOEXEC) == 0 ? 0 : errno, "pipe2");
}

Pipe::~Pipe()
{
    close_writer();
    close_reader();
}

void Pipe::close_end(int& end)
{
    if (end >= 0) {
        ::close(end);
        end = -1;
    }
}

void require_call(int code, std::string_view call)
{
    if (code != 0) {
        throw scene::EnvironmentError(fmt::format("{} failed: {}", call, std::strerror(code)));
    }
}

} // namespace gnomon::cli
