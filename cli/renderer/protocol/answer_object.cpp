#include "cli/renderer/protocol/answer_object.hpp"

#include "scene/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

constexpr int deepest = 16;

/// Cuts the text after `longest` bytes, between characters of UTF-8.
std::string cut(std::string text, std::size_t longest)
{
    if (text.size() > longest) {
        while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0U) == 0x80U) {
            --longest;
        }
        text.resize(longest);
        text += "…";
    }
    return text;
}

/// Refuses objects that are nested too deeply or give a name twice, during parsing.
class NameWatch {
public:
    bool operator()(int depth, AnswerJson::parse_event_t event, const AnswerJson& parsed)
    {
        if (depth > deepest) {
            throw BadAnswer(fmt::format("nested more than {} deep", deepest));
        }
        if (event == AnswerJson::parse_event_t::object_start) {
            names_.emplace_back();
        } else if (event == AnswerJson::parse_event_t::object_end) {
            names_.pop_back();
        } else if (event == AnswerJson::parse_event_t::key) {
            const auto name = parsed.get<std::string>();
            if (!names_.back().insert(name).second) {
                throw BadAnswer(fmt::format("\"{}\" is given twice", said_excerpt(name)));
            }
        }
        return true;
    }

private:
    std::vector<std::set<std::string>> names_;
};

constexpr std::size_t longest_end = 300; // bytes

/// The lines that are not blank.
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

AnswerJson parse_answer(const std::string& line)
{
    AnswerJson json;
    try {
        NameWatch watch;
        json = AnswerJson::parse(
            line, [&watch](int depth, AnswerJson::parse_event_t event, AnswerJson& parsed) {
                return watch(depth, event, parsed);
            });
    } catch (const AnswerJson::exception&) {
        throw BadAnswer(fmt::format("not JSON: \"{}\"; print nothing but answers to stdout, and "
                                    "everything else to stderr",
                                    said_excerpt(line)));
    }
    if (!json.is_object()) {
        throw BadAnswer(fmt::format("not a JSON object: {}", said_excerpt(line)));
    }
    return json;
}

AnswerObject::AnswerObject(const AnswerJson& json, std::string name)
    : json_{json},
      name_{std::move(name)}
{
    if (!json.is_object()) {
        throw BadAnswer(fmt::format("{} is {}; it must be an object", name_, answer_excerpt(json)));
    }
}

void AnswerObject::require_only(const std::vector<std::string_view>& members) const
{
    for (const auto& [member, value] : json_.items()) {
        if (std::ranges::find(members, member) == members.end()) {
            throw BadAnswer(fmt::format("{} is not known; known are {}",
                                        said_excerpt(name_of(member)), fmt::join(members, ", ")));
        }
    }
}

bool AnswerObject::has(std::string_view member) const
{
    return json_.contains(member);
}

const AnswerJson& AnswerObject::at(std::string_view member) const
{
    const auto found = json_.find(member);
    if (found == json_.end()) {
        throw BadAnswer(fmt::format("{} is missing", name_of(member)));
    }
    return *found;
}

double AnswerObject::number(std::string_view member) const
{
    const AnswerJson& value = at(member);
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
        throw BadAnswer(
            fmt::format("{} is {}; it must be a number", name_of(member), answer_excerpt(value)));
    }
    return value.get<double>();
}

std::int64_t AnswerObject::integer(std::string_view member) const
{
    constexpr double largest = 9007199254740992.0; // 2^53: doubles hold every integer up to it
    const double value = number(member);
    if (value != std::floor(value) || std::abs(value) > largest) {
        throw BadAnswer(fmt::format("{} is {}; it must be an integer", name_of(member),
                                    answer_excerpt(at(member))));
    }
    return static_cast<std::int64_t>(value);
}

std::string AnswerObject::text(std::string_view member, std::size_t longest) const
{
    const AnswerJson& value = at(member);
    if (!value.is_string()) {
        throw BadAnswer(
            fmt::format("{} is {}; it must be text", name_of(member), answer_excerpt(value)));
    }
    auto text = value.get<std::string>();
    if (text.empty() || text.size() > longest || scene::one_line(text) != text) {
        throw BadAnswer(fmt::format("{} is \"{}\"; it must be one line of 1 to {} bytes, without "
                                    "control characters",
                                    name_of(member), said_excerpt(text), longest));
    }
    return text;
}

std::string AnswerObject::name_of(std::string_view member) const
{
    return name_.empty() ? std::string{member} : fmt::format("{}.{}", name_, member);
}

std::string valid_text(std::string_view text)
{
    const std::string written =
        AnswerJson(text).dump(-1, ' ', false, AnswerJson::error_handler_t::replace);
    return AnswerJson::parse(written).get<std::string>();
}

std::string answer_excerpt(const AnswerJson& json)
{
    constexpr std::size_t longest = 60;
    return cut(json.dump(-1, ' ', false, AnswerJson::error_handler_t::replace), longest);
}

std::string said_excerpt(std::string_view text, std::size_t longest)
{
    return cut(scene::one_line(valid_text(text.substr(0, longest + 4))), longest);
}

std::string last_lines(const std::string& errors)
{
    std::vector<std::string> lines = filled_lines(errors);
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
