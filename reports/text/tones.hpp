#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// How a terminal shows a text.
enum class Tone : std::uint8_t {
    plain,
    bad,  ///< errors and warnings: orange
    good, ///< what to change, and that all is right: green
    dim,  ///< secondary lines
};

/// The text between the tone's escape sequences.
[[nodiscard]] inline std::string toned(std::string_view text, Tone tone)
{
    const auto between = [text](std::string_view code) {
        return std::string{"\x1b["}.append(code).append("m").append(text).append("\x1b[0m");
    };
    switch (tone) {
    case Tone::bad:
        return between("38;5;208");
    case Tone::good:
        return between("32");
    case Tone::dim:
        return between("2");
    case Tone::plain:
        break;
    }
    return std::string{text};
}

} // namespace gnomon::reports
