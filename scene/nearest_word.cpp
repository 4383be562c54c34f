#include "scene/nearest_word.hpp"

#include <algorithm>
#include <numeric>

namespace gnomon::scene {
namespace {

// A word may come from a hostile file; beyond this length no candidate is near anyway.
constexpr std::size_t longest_compared = 128;

/// Insertions, deletions and substitutions that turn `from` into `to` (Levenshtein's distance).
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

} // namespace gnomon::scene
