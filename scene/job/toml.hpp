#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::scene {

struct TomlNode;
struct TomlMember;
using TomlArray = std::vector<TomlNode>;
using TomlTable = std::vector<TomlMember>; ///< in the order of the text

/// A date or time, as TOML writes it: 2026-06-21T12:00:00Z.
struct TomlTime {
    std::string text;
};

/// A TOML value.
struct TomlNode {
    std::variant<TomlTime, bool, std::int64_t, double, std::string, TomlArray, TomlTable> value;
};

/// A key of a table, its value, and where the key stands.
struct TomlMember {
    std::string key;
    TomlNode node;
    std::uint32_t line = 0;   ///< from 1
    std::uint32_t column = 0; ///< from 1
};

/// Parses a TOML document.
/// @param source  The text's name in messages.
/// @throws InputError  "source:line:column: …", if the text is not TOML or nested too deeply.
[[nodiscard]] TomlTable parse_toml(std::string_view text, const std::string& source);

/// Parses one TOML value, as after `key =`; empty if the text is not a value.
[[nodiscard]] std::optional<TomlNode> parse_toml_value(std::string_view text);

/// The value as TOML, cut after about 60 bytes, for messages.
[[nodiscard]] std::string toml_excerpt(const TomlNode& node);

/// The text in TOML's double quotes, everything but printable characters escaped.
[[nodiscard]] std::string toml_quoted(std::string_view text);

/// A TOML number with the fewest digits that read back as the same double.
[[nodiscard]] std::string toml_number(double number);

} // namespace gnomon::scene
