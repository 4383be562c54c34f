#include "cli/renderer/protocol/renderer_start.hpp"

#include "cli/renderer/protocol/answer_object.hpp"
#include "cli/system/captured_process.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;

std::string first_line(const std::string& text)
{
    constexpr std::size_t longest = 300; // bytes
    return said_excerpt(text.substr(0, text.find('\n')), longest);
}

/// `page.mjs` and `build/engine` do; options, words and numbers do not.
bool looks_like_file(const std::string& word)
{
    constexpr std::size_t longest_ending = 5; // .html
    if (word.empty() || word.front() == '-') {
        return false;
    }
    const std::size_t dot = word.rfind('.');
    const bool has_ending = dot != std::string::npos && dot > 0 && dot + 1 < word.size() &&
                            word.size() - dot <= longest_ending &&
                            std::isalpha(static_cast<unsigned char>(word[dot + 1])) != 0;
    return has_ending || word.find('/') != std::string::npos;
}

} // namespace

std::string missing_part(const std::vector<std::string>& check)
{
    std::vector<std::string> words{"/usr/bin/env"};
    words.insert(words.end(), check.begin(), check.end());
    const CapturedEnding ending = run_captured(words);
    if (ending.status != 0) {
        return fmt::format("what it lacks cannot be told: its check ended with exit status {}{}",
                           ending.status,
                           ending.err.empty() ? std::string{} : ": " + first_line(ending.err));
    }
    return first_line(ending.out);
}

std::string start_problems(const RendererCommand& command)
{
    if (!command.check.empty()) {
        const std::string missing = missing_part(command.check);
        return missing.empty() ? std::string{} : "; " + missing;
    }
    std::string problems;
    std::error_code error;
    const std::string here = scene::one_line(fs::current_path(error).string());
    for (std::size_t i = 1; i < command.words.size(); ++i) {
        const std::string& word = command.words[i];
        if (looks_like_file(word) && !fs::exists(word, error)) {
            problems += fmt::format("; there is no file {}{}", said_excerpt(word),
                                    fs::path{word}.is_absolute() ? std::string{} : " in " + here);
        }
    }
    return problems;
}

} // namespace gnomon::cli
