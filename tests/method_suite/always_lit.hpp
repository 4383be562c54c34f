#pragma once

#include <string_view>

namespace gnomon::tests {

/// The only method in the list of always_lit.cpp.
inline constexpr std::string_view always_lit = "always_lit";

} // namespace gnomon::tests
