#pragma once

#include "scene/image.hpp"

#include <initializer_list>
#include <span>
#include <string_view>

namespace gnomon::analysis {

/// @param function  Named in the error message.
/// @throws std::invalid_argument  if one of `others` differs from `size`.
void require_equal_sizes(std::string_view function, scene::ImageSize size,
                         std::initializer_list<scene::ImageSize> others);

/// @param function  Named in the error message.
/// @throws std::invalid_argument  if the biases do not ascend strictly.
void require_ascending(std::string_view function, std::span<const float> biases);

} // namespace gnomon::analysis
