#include "cli/renderer/protocol/renderer_command.hpp"

#include "cli/renderer/protocol/answer_object.hpp"
#include "cli/system/child_process.hpp"
#include "cli/system/process.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;

std::string first_line(const std::string& text)
{
    constexpr std::size_t longest = 300; // bytes
    return said_excerpt(text.substr(0, text.find('\n')), longest);
}

/// True for `page.mjs` and `build/engine`; false for options, words and numbers.
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

constexpr const char* description_file = "renderer.toml";

fs::path engines_folder()
{
    return data_folder(GNOMON_ENGINES_FROM_PROGRAM, GNOMON_ENGINES_IN_SOURCE);
}

/// The path of the file with this name in the folder, else the word itself.
std::string word_in(const fs::path& folder, const std::string& word)
{
    std::error_code error;
    const fs::path path = folder / word;
    return !word.empty() && fs::is_regular_file(path, error) ? path.string() : word;
}

std::vector<std::string> read_texts(const scene::TomlTable& table, const std::string& source,
                                    std::string_view key, bool is_required)
{
    const auto found = std::ranges::find(table, key, &scene::TomlMember::key);
    std::vector<std::string> texts;
    if (found != table.end()) {
        const auto* const list = std::get_if<scene::TomlArray>(&found->node.value);
        for (const scene::TomlNode& node : list != nullptr ? *list : scene::TomlArray{}) {
            if (const auto* const text = std::get_if<std::string>(&node.value)) {
                texts.push_back(scene::one_line(*text));
            }
        }
        if (list == nullptr || texts.size() != list->size()) {
            throw scene::InputError(
                fmt::format("{}:{}: {}: must be a list of strings", source, found->line, key));
        }
    }
    if (is_required && texts.empty()) {
        throw scene::InputError(fmt::format("{}: {} is missing: a list of the program and its "
                                            "arguments",
                                            source, key));
    }
    return texts;
}

InstalledRenderer read_installed(const fs::path& folder)
{
    const fs::path path = folder / description_file;
    const std::string source = scene::one_line(path.string());
    const scene::TomlTable table =
        scene::parse_toml(scene::read_text_file(path, source, description_file), source);
    for (const scene::TomlMember& member : table) {
        if (member.key != "command" && member.key != "title" && member.key != "needs" &&
            member.key != "check") {
            throw scene::InputError(fmt::format("{}:{}: unknown key {}; known are command, title, "
                                                "needs and check",
                                                source, member.line,
                                                scene::toml_excerpt({member.key})));
        }
    }
    InstalledRenderer renderer{folder.filename().string(), folder, {}, {}, {}, {}};
    const auto title = std::ranges::find(table, "title", &scene::TomlMember::key);
    const auto* const text =
        title == table.end() ? nullptr : std::get_if<std::string>(&title->node.value);
    renderer.title = text != nullptr ? scene::one_line(*text) : renderer.name;
    for (const std::string& word : read_texts(table, source, "command", true)) {
        renderer.command.push_back(word_in(folder, word));
    }
    renderer.needs = read_texts(table, source, "needs", false);
    for (const std::string& word : read_texts(table, source, "check", false)) {
        renderer.check.push_back(word_in(folder, word));
    }
    return renderer;
}

/// Splits a command into words, as `given_command` describes.
class WordReader {
public:
    std::vector<std::string> read(const std::string& text)
    {
        for (std::size_t i = 0; i < text.size(); ++i) {
            take(text[i], i + 1 < text.size());
        }
        if (quote_ != 0) {
            throw scene::InputError(fmt::format("--renderer-command {}: a quote {} is not closed",
                                                scene::one_line(text), quote_));
        }
        end_word();
        return std::move(words_);
    }

private:
    void take(char c, bool has_next)
    {
        if (is_escaped_) {
            add(c);
            is_escaped_ = false;
        } else if (c == '\\' && quote_ != '\'' && has_next) {
            is_escaped_ = true;
        } else if (quote_ != 0) {
            c == quote_ ? void(quote_ = 0) : add(c);
        } else if (c == '"' || c == '\'') {
            quote_ = c;
            in_word_ = true; // "" is an empty word
        } else if (c == ' ' || c == '\t' || c == '\n') {
            end_word();
        } else {
            add(c);
        }
    }
    void add(char c)
    {
        word_ += c;
        in_word_ = true;
    }
    void end_word()
    {
        if (in_word_) {
            words_.push_back(std::exchange(word_, {}));
        }
        in_word_ = false;
    }

    std::vector<std::string> words_;
    std::string word_;
    char quote_ = 0;
    bool in_word_ = false;
    bool is_escaped_ = false;
};

} // namespace

std::string missing_part(const std::vector<std::string>& check)
{
    std::vector<std::string> words{"/usr/bin/env"};
    words.insert(words.end(), check.begin(), check.end());
    const CapturedEnding ending = run_captured(words);
    if (ending.status != 0) {
        return fmt::format("its check for missing parts failed with exit status {}{}",
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

std::vector<InstalledRenderer> installed_renderers()
{
    std::vector<InstalledRenderer> renderers;
    std::error_code error;
    for (fs::directory_iterator entry{engines_folder(), error};
         !error && entry != fs::directory_iterator{}; entry.increment(error)) {
        std::error_code none;
        if (fs::exists(entry->path() / description_file, none)) {
            renderers.push_back(read_installed(entry->path()));
        }
    }
    std::ranges::sort(renderers, {}, &InstalledRenderer::name);
    return renderers;
}

RendererCommand installed_command(const std::string& name)
{
    std::vector<std::string> names;
    for (InstalledRenderer& renderer : installed_renderers()) {
        if (renderer.name == name) {
            return {std::move(renderer.command), name, std::move(renderer.check),
                    renderer.folder / "league.toml"};
        }
        names.push_back(renderer.name);
    }
    const std::string nearest = scene::nearest_word(name, names);
    throw scene::InputError(fmt::format(
        "renderer {}: not installed in {}; {}`gnomon renderers` lists those that are, and "
        "--renderer-command starts any other",
        scene::toml_quoted(name), engines_folder().string(),
        nearest.empty() ? std::string{} : fmt::format("the nearest is {}; ", nearest)));
}

RendererCommand given_command(const std::string& text)
{
    RendererCommand command{WordReader{}.read(text), scene::one_line(text), {}, {}};
    if (command.words.empty()) {
        throw scene::InputError("--renderer-command is empty: give the program and its arguments");
    }
    std::error_code error;
    const fs::path folder = fs::current_path(error);
    for (std::string& word : command.words) {
        const bool is_found_in_path =
            &word == &command.words.front() && word.find('/') == std::string::npos;
        if (!is_found_in_path) {
            word = word_in(folder, word);
        }
    }
    return command;
}

} // namespace gnomon::cli
