#include "cli/renderer/renderer_command.hpp"

#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/toml.hpp"
#include "scene/nearest_word.hpp"
#include "scene/one_line.hpp"
#include "scene/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* description_file = "renderer.toml";

/// Beside the installed program, else in the source tree.
fs::path engines_folder()
{
    std::error_code none;
    const auto program = fs::read_symlink("/proc/self/exe", none);
    const fs::path installed = program.parent_path() / GNOMON_ENGINES_FROM_PROGRAM;
    return fs::is_directory(installed, none) ? installed.lexically_normal()
                                             : fs::path{GNOMON_ENGINES_IN_SOURCE};
}

/// The word, or the file that it names in the folder.
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
                fmt::format("{}:{}: {}: must be a list of texts", source, found->line, key));
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

/// Splits a command into words.
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
            in_word_ = true; // "" is a word, too
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
        throw scene::InputError(
            "--renderer-command: it is empty; give the program and its arguments");
    }
    std::error_code error;
    const fs::path folder = fs::current_path(error);
    for (std::string& word : command.words) {
        const bool is_of_path = &word == &command.words.front() &&
                                word.find('/') == std::string::npos; // as shells look for programs
        if (!is_of_path) {
            word = word_in(folder, word);
        }
    }
    return command;
}

} // namespace gnomon::cli
