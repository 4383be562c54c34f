#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace gnomon::testing {

/// Expects that a row of results.csv equals `gnomon compare --json` with the same settings.
void expect_row_compares(const std::map<std::string, std::string>& row,
                         const nlohmann::json& compared);

} // namespace gnomon::testing
