#pragma once

#include <string_view>

namespace gnomon::tests {

/// The only method of the list that always_lit.cpp puts in the place of the house's own.
inline constexpr std::string_view always_lit = "always_lit";

} // namespace gnomon::tests
