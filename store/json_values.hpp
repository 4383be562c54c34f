#pragma once

#include "store/json.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace gnomon::store {

[[nodiscard]] inline Json number_or_null(const std::optional<double>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

/// Bytes that are not UTF-8 become U+FFFD.
/// @param indent  -1: one line.
[[nodiscard]] inline std::string json_text(const Json& json, int indent)
{
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace gnomon::store
