#pragma once

#include <string_view>

namespace gnomon::scene {

/// Whether a key is for `layout = "cascades"` alone.
[[nodiscard]] bool is_cascade_key(std::string_view name);

} // namespace gnomon::scene
