#pragma once

#include "methods/method.hpp"

#include <span>
#include <string_view>

namespace gnomon::methods {

/// All methods, in the order in which `gnomon methods` prints them.
[[nodiscard]] std::span<const Method> methods();

/// The method of that name, or nullptr.
[[nodiscard]] const Method* find_method(std::string_view name);

/// What the job's method promises of its lookups.
[[nodiscard]] Promises promises(const scene::Job& job);

} // namespace gnomon::methods
