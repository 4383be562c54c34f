#pragma once

#include <string>
#include <string_view>

namespace gnomon::scene {

/// The text with control characters replaced by '?', so that a message stays one line.
[[nodiscard]] std::string one_line(std::string_view text);

} // namespace gnomon::scene
