#include "store/shell_text.hpp"

#include <string_view>

namespace gnomon::store {
namespace {

constexpr std::string_view plain_characters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789_-+=./:,@%";

std::string quoted(const std::string& word)
{
    if (!word.empty() && word.find_first_not_of(plain_characters) == std::string::npos) {
        return word;
    }
    std::string text{'\''};
    for (const char c : word) {
        text += c == '\'' ? std::string{"'\\''"} : std::string{c};
    }
    text += '\'';
    return text;
}

} // namespace

std::string shell_text(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) {
        text += text.empty() ? "" : " ";
        text += quoted(word);
    }
    return text;
}

} // namespace gnomon::store
