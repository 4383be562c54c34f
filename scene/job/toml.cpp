#include "scene/job/toml.hpp"
#include "scene/text.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <tuple>
#include <utility>

namespace gnomon::scene {
namespace {

/// The largest depth of brackets and number of parts of a dotted key. Job keys have at most three
/// parts; the limit protects the parser's recursive destructors.
constexpr int deepest_nesting = 32;

/// Position after the string that opens at `start`, or the end of the text (of the line, for a
/// string of one line).
std::size_t skip_string(std::string_view text, std::size_t start)
{
    const char quote = text[start];
    const bool multi_line = text.substr(start, 3) == std::string(3, quote);
    const std::string_view delimiter = text.substr(start, multi_line ? 3 : 1);
    std::size_t at = start + delimiter.size();
    while (at < text.size() && text.substr(at, delimiter.size()) != delimiter) {
        if (!multi_line && text[at] == '\n') {
            return at;
        }
        at += quote == '"' && text[at] == '\\' ? 2U : 1U;
    }
    at = std::min(at + delimiter.size(), text.size());
    // Up to two quotes may stand before the three that close a string of several lines.
    for (int extra = 0; multi_line && extra < 2 && at < text.size() && text[at] == quote; ++extra) {
        ++at;
    }
    return at;
}

/// Refuses texts whose nesting would exhaust the stack when parsed or destroyed.
void check_nesting(std::string_view text, const std::string& source)
{
    int brackets = 0;
    int key_parts = 1;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            at = skip_string(text, at);
            continue;
        }
        if (c == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (c == '[' || c == '{') {
            ++brackets;
        } else if (c == ']' || c == '}') {
            brackets = std::max(brackets - 1, 0);
        }
        if (c == '.') {
            ++key_parts;
        } else if (std::string_view{",=[]{}\n"}.find(c) != std::string_view::npos) {
            key_parts = 1;
        }
        if (std::max(brackets, key_parts) > deepest_nesting) {
            const auto line = std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
            throw InputError(fmt::format("{}:{}: nested more than {} deep: a job file needs 4",
                                         source, line + 1, deepest_nesting));
        }
        ++at;
    }
}

TomlNode node_from(const toml::node& parsed);

TomlTable table_from(const toml::table& parsed)
{
    TomlTable table;
    table.reserve(parsed.size());
    for (const auto& [key, node] : parsed) {
        const toml::source_position place = key.source().begin;
        table.push_back({std::string{key.str()}, node_from(node), place.line, place.column});
    }
    std::stable_sort(table.begin(), table.end(), [](const TomlMember& a, const TomlMember& b) {
        return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
    return table;
}

TomlNode node_from(const toml::node& parsed)
{
    if (const auto* flag = parsed.as_boolean()) {
        return {flag->get()};
    }
    if (const auto* integer = parsed.as_integer()) {
        return {integer->get()};
    }
    if (const auto* real = parsed.as_floating_point()) {
        return {real->get()};
    }
    if (const auto* text = parsed.as_string()) {
        return {text->get()};
    }
    if (const auto* array = parsed.as_array()) {
        TomlArray nodes;
        nodes.reserve(array->size());
        for (const toml::node& element : *array) {
            nodes.push_back(node_from(element));
        }
        return {std::move(nodes)};
    }
    if (const auto* table = parsed.as_table()) {
        return {table_from(*table)};
    }
    std::ostringstream text;
    parsed.visit([&](const auto& value) {
        if constexpr (toml::is_chronological<decltype(value)>) {
            text << value.get();
        }
    });
    return {TomlTime{text.str()}};
}

/// Appends the value as TOML, stopping soon after `longest` bytes.
void append_toml(std::string& out, const TomlNode& node, std::size_t longest)
{
    if (const auto* time = std::get_if<TomlTime>(&node.value)) {
        out += time->text;
    } else if (const bool* flag = std::get_if<bool>(&node.value)) {
        out += *flag ? "true" : "false";
    } else if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
        out += fmt::format("{}", *integer);
    } else if (const double* real = std::get_if<double>(&node.value)) {
        out += toml_number(*real);
    } else if (const auto* text = std::get_if<std::string>(&node.value)) {
        out += toml_quoted(std::string_view{*text}.substr(0, longest + 1));
    } else if (const auto* array = std::get_if<TomlArray>(&node.value)) {
        out += '[';
        for (std::size_t i = 0; i < array->size() && out.size() <= longest; ++i) {
            out += i == 0 ? "" : ", ";
            append_toml(out, (*array)[i], longest);
        }
        out += ']';
    } else {
        out += "{…}";
    }
}

} // namespace

TomlTable parse_toml(std::string_view text, const std::string& source)
{
    check_nesting(text, source);
    try {
        return table_from(toml::parse(text));
    } catch (const toml::parse_error& error) {
        const toml::source_position place = error.source().begin;
        throw InputError(fmt::format("{}:{}:{}: not TOML: {}", source, place.line, place.column,
                                     one_line(error.description())));
    }
}

std::optional<TomlNode> parse_toml_value(std::string_view text)
{
    try {
        TomlTable table = parse_toml(fmt::format("value = {}", text), "value");
        if (table.size() == 1 && table.front().key == "value") {
            return std::move(table.front().node);
        }
    } catch (const InputError&) {
        // The caller reports the error, because it knows the context.
    }
    return std::nullopt;
}

std::string toml_excerpt(const TomlNode& node)
{
    constexpr std::size_t longest = 60;
    std::string text;
    append_toml(text, node, longest);
    if (text.size() > longest) {
        std::size_t end = longest;
        // Keeps UTF-8 characters whole: continuation bytes are 10xxxxxx.
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
            --end;
        }
        text = text.substr(0, end) + "…";
    }
    return text;
}

std::string toml_quoted(std::string_view text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += '\\';
            quoted += c;
        } else if (byte < 0x20 || byte == 0x7F) {
            quoted += fmt::format("\\u{:04X}", byte);
        } else {
            quoted += c;
        }
    }
    return quoted + '"';
}

std::string toml_number(double number)
{
    std::string text = fmt::format("{:g}", number); // 1e+15, not 1000000000000000
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    if (back != number) {
        text = fmt::format("{}", number);
    }
    // "-0" would read back as the integer zero, without its sign.
    return text == "-0" ? "-0.0" : text;
}

} // namespace gnomon::scene
