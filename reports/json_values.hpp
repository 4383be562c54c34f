#pragma once

#include <nlohmann/json.hpp>

#include <optional>

namespace gnomon::reports {

using Json = nlohmann::ordered_json;

[[nodiscard]] inline Json number_or_null(const std::optional<double>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

} // namespace gnomon::reports
