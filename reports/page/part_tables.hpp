#pragma once

#include "store/json.hpp"

#include <string>
#include <string_view>

namespace gnomon::reports {

/// Errors by object in HTML, most errors first, or why they are not known.
/// @param detail  of `compare --json`; null: not kept.
[[nodiscard]] std::string objects_table(const store::Json& detail);

/// Errors by map, and of cascades what each sees; empty of a light with one map.
[[nodiscard]] std::string maps_table(const store::Json& detail, std::string_view unit);

} // namespace gnomon::reports
