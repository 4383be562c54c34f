#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace gnomon::testing {

/// Holds every column of a row of results.csv against `gnomon compare --json` of the same settings.
void expect_row_compares(const std::map<std::string, std::string>& row,
                         const nlohmann::json& compared);

} // namespace gnomon::testing
