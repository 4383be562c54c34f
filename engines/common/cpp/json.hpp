#pragma once

#include <nlohmann/json.hpp>

namespace engine {

/// Members keep the order in which they are written.
using Json = nlohmann::ordered_json;

} // namespace engine
