#pragma once

#include "scene/job/keys/key_table.hpp"

namespace gnomon::methods {

/// The table of keys with those of all methods.
/// @throws std::invalid_argument  for a bias term that no lookup does as it says, and where keys of
///                                one name differ.
[[nodiscard]] const scene::Keys& key_table();

} // namespace gnomon::methods
