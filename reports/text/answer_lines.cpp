#include "reports/text/answer_lines.hpp"

#include "reports/text/text.hpp"

#include <algorithm>

namespace gnomon::reports {

namespace {

constexpr std::size_t label_width = 10;

/// Whether a word is a unit, which stays in the line of its number.
bool is_unit(std::string_view word)
{
    const std::string_view letters = word.substr(0, word.find_last_not_of(".,;:)") + 1);
    return letters == "%" || letters == "m" || letters == "px" || letters == "MiB" ||
           letters == "units" || letters == "texels";
}

std::size_t next_blank(std::string_view text, std::size_t begin)
{
    return std::min(text.find(' ', begin), text.size());
}

/// The end of the word that begins at `begin`, with the unit of a number and the value of a key.
std::size_t end_of_word(std::string_view text, std::size_t begin)
{
    std::size_t end = next_blank(text, begin);
    while (end < text.size()) {
        const std::size_t next = next_blank(text, end + 1);
        const std::string_view word = text.substr(end + 1, next - end - 1);
        if (is_unit(word)) {
            end = next;
        } else if (word == "=" && next < text.size()) {
            end = next_blank(text, next + 1);
        } else {
            break;
        }
    }
    return end;
}

} // namespace

std::vector<std::string> wrapped(std::string_view text, std::size_t columns)
{
    std::vector<std::string> lines{""};
    std::size_t begin = 0;
    while (begin < text.size()) {
        // Runs of blanks stay: they set off the comment of a key.
        const std::size_t word = text.find_first_not_of(' ', begin);
        if (word == std::string_view::npos) {
            break;
        }
        const std::size_t end = end_of_word(text, word);
        const std::string_view piece = text.substr(begin, end - begin);
        if (!lines.back().empty() && text_columns(lines.back()) + text_columns(piece) > columns) {
            lines.emplace_back(text.substr(word, end - word));
        } else {
            lines.back() += piece;
        }
        begin = end;
    }
    return lines;
}

void AnswerLines::sentence(std::string_view text, Tone tone)
{
    for (const std::string& line : wrapped(text, answer_columns)) {
        lines_.push_back(shown(line, tone));
    }
}

void AnswerLines::entry(std::string_view label, std::string_view text, Tone tone)
{
    for (const std::string& line : wrapped(text, answer_columns - label_width)) {
        lines_.push_back(
            shown(pad_right(label, label_width), tone == Tone::dim ? tone : Tone::plain) +
            shown(line, tone));
        label = {};
    }
}

void AnswerLines::flagged(std::string_view label, std::string_view text, Tone tone)
{
    for (const std::string& line : wrapped(text, answer_columns - label_width)) {
        lines_.push_back(shown(pad_right(label, label_width), tone) + line);
        label = {};
        tone = Tone::plain;
    }
}

void AnswerLines::append(const AnswerLines& other)
{
    lines_.insert(lines_.end(), other.lines_.begin(), other.lines_.end());
}

std::string AnswerLines::text() const
{
    std::string text;
    for (const std::string& line : lines_) {
        text += line + "\n";
    }
    return text;
}

} // namespace gnomon::reports
