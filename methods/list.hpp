#pragma once

#include "methods/method.hpp"

#include <span>

namespace gnomon::methods {

/// All methods, in the order of `gnomon methods`. list.cpp holds only this list, so that a program
/// can link its own.
[[nodiscard]] std::span<const Method> methods();

} // namespace gnomon::methods
