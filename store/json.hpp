#pragma once

#include <nlohmann/json_fwd.hpp>

namespace gnomon::store {

/// Members keep the order in which they are written. Only declared here; json_values.hpp defines
/// it.
using Json = nlohmann::ordered_json;

} // namespace gnomon::store
