#pragma once

#include "methods/method.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// The methods with their sources, keys (unit, default, allowed values, stages), bias terms, and
/// what they promise, as the JSON array that `gnomon methods --json` prints.
[[nodiscard]] std::string methods_json(std::span<const methods::Method> methods);

} // namespace gnomon::reports
