#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// A CSV file, read as RFC 4180 defines it.
struct CsvTable {
    std::vector<std::string> columns;
    std::vector<std::map<std::string, std::string>> rows;
};

[[nodiscard]] CsvTable parse_csv(std::string_view text);
[[nodiscard]] CsvTable read_csv(const std::filesystem::path& path);

} // namespace gnomon::store
