#include "scene/one_line.hpp"

#include <algorithm>

namespace gnomon::scene {

std::string one_line(std::string_view text)
{
    std::string line{text};
    std::replace_if(
        line.begin(), line.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7F'; }, '?');
    return line;
}

} // namespace gnomon::scene
