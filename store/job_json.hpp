#pragma once

#include "analysis/comparison/comparison.hpp"
#include "store/json.hpp"

#include <string>

namespace gnomon::store {

/// The comparison's job, a member a key; of another renderer's case the keys that it gives. Values
/// come in TOML's syntax, which for numbers, booleans, plain strings and arrays is JSON's, too;
/// anything else stays the text that it is.
[[nodiscard]] Json job_object(const analysis::Comparison& comparison);
/// The job's keys and values as a JSON object on one line; of another renderer's case those given.
[[nodiscard]] std::string job_json(const analysis::Comparison& comparison);

} // namespace gnomon::store
