#pragma once

#include "reports/text/tones.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// Columns of an answer's lines at most, except for longer words.
inline constexpr std::size_t answer_columns = 110;

/// The lines of an answer for people: a label in a narrow column, and a text beside it that goes
/// on in the next line where it is too long.
class AnswerLines {
public:
    /// @param in_colour  Whether tones become escape sequences.
    explicit AnswerLines(bool in_colour) : in_colour_{in_colour} {}

    /// A sentence across all columns.
    void sentence(std::string_view text, Tone tone = Tone::plain);
    /// One line of any length, as a command to paste must be.
    void unbroken(std::string_view text, Tone tone) { lines_.push_back(shown(text, tone)); }
    /// "fix       bias.constant = 0.002". An empty label continues the entry above.
    void entry(std::string_view label, std::string_view text, Tone tone = Tone::plain);
    /// Like `entry`, with the tone on the label.
    void flagged(std::string_view label, std::string_view text, Tone tone);
    void append(const AnswerLines& other);

    [[nodiscard]] std::size_t size() const { return lines_.size(); }
    /// All lines, each with its line feed.
    [[nodiscard]] std::string text() const;

private:
    [[nodiscard]] std::string shown(std::string_view text, Tone tone) const
    {
        return in_colour_ && !text.empty() ? toned(text, tone) : std::string{text};
    }

    bool in_colour_;
    std::vector<std::string> lines_;
};

/// The text in lines of at most so many columns; longer words have a line of their own. A number
/// keeps its unit beside it, and a key its value.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t columns);

} // namespace gnomon::reports
