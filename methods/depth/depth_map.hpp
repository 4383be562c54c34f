#pragma once

#include "methods/method.hpp"

#include <cstdint>

namespace gnomon::methods {

/// The method "depth": a map of depths as seen from the light, compared with the receiver's.
[[nodiscard]] Method depth_map();

/// Memory that a map takes [bytes]; u-formats as if GL had them.
[[nodiscard]] std::uint64_t map_bytes(const scene::Job& job);

} // namespace gnomon::methods
