#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace gnomon::scene {

/// One line of valid UTF-8: names and messages from files end up in JSON, CSV and terminals.
///
/// Control characters become spaces, bytes that are no UTF-8 question marks.
[[nodiscard]] std::string printable(std::string_view text);

/// What a file's name ends with, in small letters: ".glb".
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// Hands out "name", "name.2", "name.3", and never the same name twice.
class UniqueNames {
public:
    [[nodiscard]] std::string make(std::string_view wanted);

private:
    std::unordered_map<std::string, std::uint64_t> last_number_;
    std::unordered_set<std::string> taken_;
};

} // namespace gnomon::scene
