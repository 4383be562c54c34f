#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// The candidate that needs the fewest edits to become `word`, of several the first; empty without
/// candidates.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& candidates);
/// The same, but empty if more than half of the longer word's letters are edited: too far off to be
/// meant.
[[nodiscard]] std::string similar_word(std::string_view word,
                                       const std::vector<std::string>& candidates);

} // namespace gnomon::scene
