#pragma once

#include "scene/job/keys/key_table.hpp"

namespace gnomon::methods {

/// The key table including the keys of all methods.
/// @throws std::invalid_argument  for an inconsistent bias term, and if keys of one name differ.
[[nodiscard]] const scene::Keys& key_table();

} // namespace gnomon::methods
