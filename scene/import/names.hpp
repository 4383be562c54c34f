#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace gnomon::scene {

/// Makes a text one line of valid UTF-8, for JSON, CSV and terminals.
///
/// Control characters become spaces; invalid bytes become question marks.
[[nodiscard]] std::string printable(std::string_view text);

/// A file name's extension in lower case: ".glb".
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// Makes names unique: "name", "name.2", "name.3".
class UniqueNames {
public:
    [[nodiscard]] std::string make(std::string_view wanted);

private:
    std::unordered_map<std::string, std::uint64_t> last_number_;
    std::unordered_set<std::string> taken_;
};

} // namespace gnomon::scene
