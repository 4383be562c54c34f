#include "scene/text.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <numeric>

namespace gnomon::scene {

std::string one_line(std::string_view text)
{
    std::string line{text};
    std::replace_if(
        line.begin(), line.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7F'; }, '?');
    return line;
}

std::string lower_case(std::string_view text)
{
    std::string lower{text};
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) {
        return static_cast<char>(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
    });
    return lower;
}

std::string grouped(std::uint64_t count)
{
    const std::string digits = std::to_string(count);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) {
            text += ',';
        }
        text += digits[i];
    }
    return text;
}

std::string counted(std::uint64_t count, std::string_view noun)
{
    return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

namespace {

// Words may come from a hostile file; no candidate is near a longer one.
constexpr std::size_t longest_compared = 128;

/// The Levenshtein distance: insertions, deletions and substitutions.
std::size_t edit_distance(std::string_view from, std::string_view to)
{
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t substitution = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substitution, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates)
{
    std::string nearest;
    std::size_t fewest = 0;
    for (const std::string& candidate : candidates) {
        const std::size_t edits = edit_distance(word.substr(0, longest_compared), candidate);
        if (nearest.empty() || edits < fewest) {
            nearest = candidate;
            fewest = edits;
        }
    }
    return nearest;
}

std::string similar_word(std::string_view word, const std::vector<std::string>& candidates)
{
    std::string nearest = nearest_word(word, candidates);
    const std::size_t longer = std::max(word.size(), nearest.size());
    return 2 * edit_distance(word.substr(0, longest_compared), nearest) <= longer ? nearest
                                                                                  : std::string{};
}

std::string read_text_file(const std::filesystem::path& path, const std::string& name,
                           const std::string& kind, std::uint64_t most_bytes)
{
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        throw InputError(fmt::format("{}: is a folder; name a {} in it", name, kind));
    }
    errno = 0;
    std::ifstream file{path, std::ios::binary};
    if (!file) {
        throw InputError(
            fmt::format("{}: cannot be opened: {}; check the path", name, std::strerror(errno)));
    }
    std::string text;
    std::array<char, 65536> block{};
    while (file.read(block.data(), block.size()) || file.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(file.gcount()));
        if (text.size() > most_bytes) {
            throw InputError(fmt::format("{}: longer than {} MiB: this is not a {}", name,
                                         most_bytes >> 20U, kind));
        }
    }
    if (file.bad()) {
        throw InputError(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
    }
    return text;
}

} // namespace gnomon::scene
