#pragma once

#include <nlohmann/json.hpp>

namespace engine {

/// JSON whose members keep their order.
using Json = nlohmann::ordered_json;

} // namespace engine
