#pragma once

#include <string_view>

namespace gnomon::methods {

/// The text of an embedded GLSL snippet: "mean_of_comparisons.glsl".
/// @throws std::invalid_argument  if no snippet has that name.
[[nodiscard]] std::string_view glsl_source(std::string_view name);

} // namespace gnomon::methods
