#pragma once

namespace gnomon::methods {

/// Hands names and keys of all methods to the table of keys (`scene::hand_over_methods`): once,
/// before it is read.
/// @throws std::invalid_argument  for a bias term that no lookup does as it says, and where keys of
///                                one name differ.
void hand_keys_to_scene();

} // namespace gnomon::methods
