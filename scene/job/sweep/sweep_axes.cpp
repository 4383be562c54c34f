#include "scene/job/sweep/sweep_axes.hpp"

#include "scene/error.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon::scene {
namespace {

/// Of one axis, and of all axes together: limits the memory that a hostile file can request.
constexpr std::int64_t most_values = 100'000;
constexpr std::int64_t largest_count = 1'000'000'000;

/// The members of `{from, to, count, scale}`.
struct Range {
    double from = 0;
    double to = 0;
    std::int64_t count = 0;
    bool is_logarithmic = false;
};

/// Reads a value that does not belong to a key, and checks its domain.
JobValue read_member(const Domain& domain, const TomlNode& node, const std::string& label)
{
    auto value = read_value(domain, node);
    if (!value) {
        throw InputError(
            fmt::format("{} = {}: {}", label, toml_excerpt(node), refusal_text(domain, node)));
    }
    return std::move(*value);
}

const TomlNode* find_member(const TomlTable& table, std::string_view key)
{
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const TomlMember& member) { return member.key == key; });
    return found == table.end() ? nullptr : &found->node;
}

const TomlNode& needed_member(const TomlTable& table, std::string_view key,
                              const std::string& label)
{
    const TomlNode* node = find_member(table, key);
    if (node == nullptr) {
        throw InputError(
            fmt::format("{}: \"{}\" is missing from {{from, to, count, scale}}", label, key));
    }
    return *node;
}

/// Reads an end of a range, a number that the axis's key accepts.
double range_end(const WrittenKey& key, const TomlTable& table, std::string_view end,
                 const std::string& label)
{
    const TomlNode& node = needed_member(table, end, label);
    const JobValue value =
        make_setting(key, node, fmt::format("{}, {} = {}", label, end, toml_excerpt(node))).value;
    if (const double* real = std::get_if<double>(&value)) {
        return *real;
    }
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return static_cast<double>(*integer);
    }
    throw InputError(fmt::format("{}: only numbers have a range; list the values", label));
}

Range read_range(const WrittenKey& key, const TomlTable& table, const std::string& label)
{
    const std::vector<std::string> members{"from", "to", "count", "scale"};
    for (const TomlMember& member : table) {
        if (std::find(members.begin(), members.end(), member.key) == members.end()) {
            throw InputError(fmt::format("{}: unknown key {}; the nearest is {}", label,
                                         toml_excerpt({member.key}),
                                         nearest_word(member.key, members)));
        }
    }
    Range range;
    range.from = range_end(key, table, "from", label);
    range.to = range_end(key, table, "to", label);
    range.count = std::get<std::int64_t>(read_member(
        IntegerDomain{2, most_values}, needed_member(table, "count", label), label + ", count"));
    if (const TomlNode* scale = find_member(table, "scale")) {
        const WordDomain words{.words = {"linear", "log"}};
        range.is_logarithmic =
            std::get<std::string>(read_member(words, *scale, label + ", scale")) == "log";
    }
    if (range.is_logarithmic && !(range.from > 0 && range.to > 0)) {
        throw InputError(label + ": from and to must be above 0 for scale = \"log\"");
    }
    if (range.from == range.to) {
        throw InputError(label + ": from and to must differ");
    }
    return range;
}

/// The i-th value of the range. Both ends are exact, whatever the rounding between.
double range_value(const Range& range, std::int64_t i)
{
    if (i == 0) {
        return range.from;
    }
    if (i == range.count - 1) {
        return range.to;
    }
    const auto step = static_cast<double>(i);
    const auto steps = static_cast<double>(range.count - 1);
    double value = range.from + (range.to - range.from) * step / steps;
    if (range.is_logarithmic) {
        const double first = std::log10(range.from);
        const double last = std::log10(range.to);
        value = std::pow(10.0, first + (last - first) * step / steps);
    }
    return std::clamp(value, std::min(range.from, range.to), std::max(range.from, range.to));
}

std::vector<TomlNode> expand(const WrittenKey& key, const TomlTable& table,
                             const std::string& label)
{
    const Range range = read_range(key, table, label);
    const bool is_integer = std::holds_alternative<IntegerDomain>(key.spec->domain);
    std::vector<TomlNode> values;
    double previous = 0;
    for (std::int64_t i = 0; i < range.count; ++i) {
        const double exact = range_value(range, i);
        const double value = is_integer ? std::round(exact) : exact;
        if (i > 0 && value == previous) {
            throw InputError(fmt::format("{}: {} comes twice; lower the count", label, value));
        }
        if (is_integer) {
            values.emplace_back().value = std::int64_t{std::llround(value)};
        } else {
            values.emplace_back().value = value;
        }
        previous = value;
    }
    return values;
}

SweepAxis read_axis(const WrittenKey& key, const TomlNode& node, const std::string& label)
{
    const auto* list = std::get_if<TomlArray>(&node.value);
    const auto* table = std::get_if<TomlTable>(&node.value);
    if ((list == nullptr && table == nullptr) || (list != nullptr && list->empty())) {
        throw InputError(fmt::format("{} = {}: must be a list of values, or {{from, to, count, "
                                     "scale}}",
                                     label, toml_excerpt(node)));
    }
    if (list != nullptr && list->size() > static_cast<std::size_t>(most_values)) {
        throw InputError(
            fmt::format("{}: {} values; at most {}", label, list->size(), most_values));
    }
    SweepAxis axis{key.text(), {}};
    for (const TomlNode& value : list != nullptr ? *list : expand(key, *table, label)) {
        const Setting setting =
            make_setting(key, value, fmt::format("{} = {}", label, toml_excerpt(value)));
        axis.values.push_back(to_toml(setting.value));
    }
    return axis;
}

/// Reads mode, sample and seed; returns false for other members.
bool read_option(Sweep& sweep, const TomlMember& member, const std::string& file)
{
    const std::string label = KeyPlace{file, member.line}.text() + "[sweep] " + member.key;
    if (member.key == "mode") {
        const WordDomain modes{.words = {"product", "zip"}};
        sweep.mode = std::get<std::string>(read_member(modes, member.node, label));
    } else if (member.key == "sample") {
        sweep.sample = std::get<std::int64_t>(
            read_member(IntegerDomain{0, largest_count}, member.node, label));
    } else if (member.key == "seed") {
        sweep.seed = std::get<std::int64_t>(read_member(
            IntegerDomain{0, std::numeric_limits<std::int64_t>::max()}, member.node, label));
    } else {
        return false;
    }
    return true;
}

/// Splits the text at commas outside brackets, braces and quotes.
std::vector<std::string> split_at_commas(std::string_view text)
{
    std::vector<std::string> parts(1);
    int depth = 0;
    char quote = 0;
    for (const char c : text) {
        if (quote != 0) {
            quote = c == quote ? '\0' : quote;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '[' || c == '{') {
            ++depth;
        } else if (c == ']' || c == '}') {
            --depth;
        } else if (c == ',' && depth == 0) {
            parts.emplace_back();
            continue;
        }
        parts.back() += c;
    }
    return parts;
}

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t");
    return first == std::string_view::npos
               ? std::string_view{}
               : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Whether one pair of brackets encloses the text: "[a, b]", but not "[0, 1], [2, 3]".
bool is_bracketed(std::string_view text)
{
    const bool has_brackets = text.size() >= 2 && text.front() == '[' && text.back() == ']';
    return has_brackets && split_at_commas(text).size() == 1;
}

/// Reads a range, a list, or comma-separated values, where a bare word is a string.
TomlNode axis_values(std::string_view text, const std::string& label)
{
    std::string_view inner = trimmed(text);
    if (auto node = parse_toml_value(inner);
        node && (std::holds_alternative<TomlArray>(node->value) ||
                 std::holds_alternative<TomlTable>(node->value))) {
        return std::move(*node);
    }
    if (is_bracketed(inner)) {
        inner = inner.substr(1, inner.size() - 2);
    }
    TomlArray values;
    for (const std::string& part : split_at_commas(inner)) {
        const std::string_view word = trimmed(part);
        auto node = parse_toml_value(word);
        if (!node && (word.empty() || word.find_first_of("[]{}\"'=") != std::string_view::npos)) {
            throw InputError(fmt::format(
                "{}: write a list, [512, 1024], or a range, {{from = 1e-6, to = 0.1, count = 50, "
                "scale = \"log\"}}",
                label));
        }
        values.push_back(node ? std::move(*node) : TomlNode{std::string{word}});
    }
    return {std::move(values)};
}

} // namespace

void check_axis_lengths(const Sweep& sweep, const std::string& file)
{
    std::size_t value_count = 0;
    for (const SweepAxis& axis : sweep.axes) {
        value_count += axis.values.size();
        if (value_count > static_cast<std::size_t>(most_values)) {
            throw InputError(fmt::format("{}: [sweep] {}: more than {} values on all axes", file,
                                         axis.key, most_values));
        }
        const SweepAxis& first = sweep.axes.front();
        if (sweep.mode == "zip" && axis.values.size() != first.values.size()) {
            throw InputError(fmt::format("{}: [sweep] mode = \"zip\": axes must be equally long, "
                                         "but {} has {} values and {} has {}",
                                         file, first.key, first.values.size(), axis.key,
                                         axis.values.size()));
        }
    }
}

std::string axis_argument_of_light(const KeyTable& keys, const std::string& argument,
                                   std::string_view light)
{
    const std::size_t equals = std::min(argument.find('='), argument.size());
    const WrittenKey key = find_written_key(keys, std::string_view{argument}.substr(0, equals));
    return key && key.light == light ? key.spec->name + argument.substr(equals) : argument;
}

std::vector<SweepAxis> axes_of_light(const KeyTable& keys, const std::vector<SweepAxis>& axes,
                                     std::string_view light)
{
    std::vector<SweepAxis> of_light;
    for (const std::string_view whose : {std::string_view{}, light}) {
        for (const SweepAxis& axis : axes) {
            const WrittenKey key = find_written_key(keys, axis.key);
            if (key.light != whose) {
                continue;
            }
            const std::string& name = key.spec->name;
            std::erase_if(of_light, [&](const SweepAxis& all) { return all.key == name; });
            of_light.push_back({name, axis.values});
        }
    }
    return of_light;
}

SweepAxis read_axis_argument(const KeyTable& keys, const std::string& argument)
{
    const std::size_t equals = argument.find('=');
    const std::string label = fmt::format("--axis {}", one_line(argument));
    if (equals == std::string::npos || equals == 0) {
        throw InputError(fmt::format(
            "{}: write KEY=VALUES, e.g. --axis shadow_map.resolution=512,1024,2048", label));
    }
    const std::string name = argument.substr(0, equals);
    const WrittenKey key = find_written_key(keys, name);
    if (!key && is_preset_key(name)) {
        throw InputError(fmt::format("{}: {}", label, preset_place));
    }
    if (!key) {
        throw InputError(fmt::format("{}: unknown key {}; the nearest is {}", label,
                                     toml_excerpt({name}), nearest_written_key(keys, name)));
    }
    return read_axis(key, axis_values(argument.substr(equals + 1), label),
                     fmt::format("--axis {}", name));
}

Sweep read_sweep(const KeyTable& keys, const TomlMember& member, const std::string& file)
{
    const auto* table = std::get_if<TomlTable>(&member.node.value);
    if (table == nullptr) {
        throw InputError(KeyPlace{file, member.line}.text() + "sweep: must be a table, [sweep]");
    }
    Sweep sweep;
    TomlTable axes;
    for (const TomlMember& entry : *table) {
        if (!read_option(sweep, entry, file)) {
            axes.push_back(entry);
        }
    }
    for_each_key(keys, axes, file, {"mode", "sample", "seed"},
                 [&](const WrittenKey& key, const TomlNode& node, const KeyPlace& place) {
                     const std::string name = key.text();
                     const bool is_repeated =
                         std::any_of(sweep.axes.begin(), sweep.axes.end(),
                                     [&](const SweepAxis& axis) { return axis.key == name; });
                     if (is_repeated) {
                         throw InputError(
                             fmt::format("{}[sweep] {}: the axis is given twice; keep one",
                                         place.text(), name));
                     }
                     sweep.axes.push_back(
                         read_axis(key, node, fmt::format("{}[sweep] {}", place.text(), name)));
                     check_axis_lengths(sweep, file);
                 });
    return sweep;
}

} // namespace gnomon::scene
