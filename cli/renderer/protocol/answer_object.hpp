#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

using AnswerJson = nlohmann::ordered_json;

/// An answer breaks the protocol; `what()` says how.
class BadAnswer : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Parses a line.
/// @throws BadAnswer  if it is not one JSON object, is nested too deeply, or gives a name twice.
[[nodiscard]] AnswerJson parse_answer(const std::string& line);

/// Reads an object of an answer; every message names the member.
class AnswerObject {
public:
    /// @param name  "keys[2]", for messages; empty: the answer itself.
    /// @throws BadAnswer  if it is not an object.
    AnswerObject(const AnswerJson& json, std::string name);

    /// @throws BadAnswer  for other members than these.
    void require_only(const std::vector<std::string_view>& members) const;
    [[nodiscard]] bool has(std::string_view member) const;
    /// @throws BadAnswer  if it is missing, or of another type.
    [[nodiscard]] const AnswerJson& at(std::string_view member) const;
    [[nodiscard]] double number(std::string_view member) const;
    [[nodiscard]] std::int64_t integer(std::string_view member) const;
    /// One line of text without control characters.
    /// @param longest  [bytes]
    [[nodiscard]] std::string text(std::string_view member, std::size_t longest) const;
    /// "keys[2].range", for messages.
    [[nodiscard]] std::string name_of(std::string_view member) const;

private:
    const AnswerJson& json_;
    std::string name_;
};

/// Replaces invalid UTF-8 by U+FFFD.
[[nodiscard]] std::string valid_text(std::string_view text);
/// The value as JSON, cut after about 60 bytes, for messages.
[[nodiscard]] std::string answer_excerpt(const AnswerJson& json);
/// A renderer's text on one line, cut after `longest` bytes, for messages.
[[nodiscard]] std::string said_excerpt(std::string_view text, std::size_t longest = 80);

/// The end of a program's stderr, on one line of at most about 300 bytes. Drops indented lines,
/// such as stack traces and quoted code, if there are others.
/// @param errors  lines; the first may be cut.
[[nodiscard]] std::string last_lines(const std::string& errors);

} // namespace gnomon::cli
