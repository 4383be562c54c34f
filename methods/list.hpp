#pragma once

#include "methods/method.hpp"

#include <span>

namespace gnomon::methods {

/// All methods, in the order in which `gnomon methods` prints them. The list stands in a file of
/// its own, so that a program can be linked with another.
[[nodiscard]] std::span<const Method> methods();

} // namespace gnomon::methods
