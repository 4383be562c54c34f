#include "cli/renderer/protocol/last_lines.hpp"

#include "cli/renderer/protocol/answer_object.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

constexpr std::size_t longest_end = 300; // bytes

/// The lines that hold something.
std::vector<std::string> filled_lines(const std::string& text)
{
    std::vector<std::string> lines;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
        std::string line = text.substr(begin, end - begin);
        if (line.find_first_not_of(" \t") != std::string::npos) {
            lines.push_back(std::move(line));
        }
        begin = end + 1;
    }
    return lines;
}

bool is_indented(const std::string& line)
{
    return line.front() == ' ' || line.front() == '\t';
}

} // namespace

std::string last_lines(const std::string& complaints)
{
    std::vector<std::string> lines = filled_lines(complaints);
    if (!std::ranges::all_of(lines, is_indented)) {
        std::erase_if(lines, is_indented);
    }
    std::size_t bytes = 0;
    auto first = lines.end();
    while (first != lines.begin() &&
           (first == lines.end() || bytes + std::prev(first)->size() <= longest_end)) {
        --first;
        bytes += first->size();
    }
    return said_excerpt(fmt::format("{}", fmt::join(first, lines.end(), " | ")), longest_end);
}

} // namespace gnomon::cli
