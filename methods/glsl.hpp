#pragma once

#include <string_view>

namespace gnomon::methods {

/// The text of a method's piece of GLSL, embedded at build time: "mean_of_comparisons.glsl".
/// @throws std::invalid_argument  if there is none of that name.
[[nodiscard]] std::string_view glsl_source(std::string_view name);

} // namespace gnomon::methods
