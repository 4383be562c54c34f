#include "scene/import/names.hpp"

#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::scene {

namespace {

/// Length of the valid UTF-8 sequence that `text` begins with; 0 if it begins with none.
std::size_t utf8_length(std::string_view text)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t length = byte(0) < 0x80                      ? 1
                               : byte(0) >= 0xC2 && byte(0) < 0xE0 ? 2
                               : byte(0) >= 0xE0 && byte(0) < 0xF0 ? 3
                               : byte(0) >= 0xF0 && byte(0) < 0xF5 ? 4
                                                                   : 0;
    if (length == 0 || length > text.size()) {
        return 0;
    }
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) {
            return 0;
        }
    }
    const bool is_overlong =
        (byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xF0 && byte(1) < 0x90);
    const bool is_outside =
        (byte(0) == 0xED && byte(1) > 0x9F) || (byte(0) == 0xF4 && byte(1) > 0x8F);
    return is_overlong || is_outside ? 0 : length;
}

} // namespace

std::string printable(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto first = static_cast<unsigned char>(text.front());
        if (length == 0 || first < 0x20 || first == 0x7F) {
            result += length == 0 ? '?' : ' ';
            text.remove_prefix(1);
        } else {
            result += text.substr(0, length);
            text.remove_prefix(length);
        }
    }
    result.erase(result.find_last_not_of(' ') + 1);
    return result;
}

std::string lower_extension(const std::filesystem::path& path)
{
    return lower_case(path.extension().string());
}

std::string UniqueNames::make(std::string_view wanted)
{
    const std::string base{wanted};
    std::uint64_t& number = last_number_[base];
    std::string name = base;
    while (!taken_.insert(name).second) {
        number = std::max<std::uint64_t>(number, 1) + 1;
        name = fmt::format("{}.{}", base, number);
    }
    return name;
}

} // namespace gnomon::scene
