#pragma once

#include <nlohmann/json_fwd.hpp>

namespace gnomon::store {

/// JSON whose members keep their order. Only declared here; json_values.hpp defines it.
using Json = nlohmann::ordered_json;

} // namespace gnomon::store
