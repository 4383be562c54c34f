#include "cli/system/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace gnomon::cli {
namespace {

/// A variable of the environment; empty if unset.
std::string_view variable(const char* name)
{
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string_view{} : std::string_view{value};
}

} // namespace

bool stdout_has_colours()
{
    return ::isatty(STDOUT_FILENO) == 1 && variable("TERM") != "dumb" &&
           variable("NO_COLOR").empty();
}

} // namespace gnomon::cli
