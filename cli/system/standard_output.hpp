#pragma once

#include "scene/error.hpp"

#include <string_view>

namespace gnomon::cli {

/// Nobody reads stdout any more, as behind `| head`: an end without a message.
class BrokenPipe : public scene::EnvironmentError {
public:
    BrokenPipe() : EnvironmentError{"standard output: nobody reads it"} {}
};

/// Writes to stdout and flushes.
/// @throws BrokenPipe               if it is a pipe that nobody reads.
/// @throws scene::EnvironmentError  if the bytes cannot be written, e.g. on a full disk.
void print(std::string_view text);

} // namespace gnomon::cli
