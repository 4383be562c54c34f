#include "scene/job/presets/engine.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::scene {
namespace {

/// Reads the members of one table; each may be taken once, and none may be left over.
class Members {
public:
    Members(std::string where, const TomlTable& table) : where_{std::move(where)}, left_{table} {}

    [[noreturn]] void refuse(std::string_view why) const
    {
        throw InputError(fmt::format("{}: {}", where_, why));
    }

    [[nodiscard]] std::optional<TomlNode> take(std::string_view key)
    {
        const auto found = std::ranges::find(left_, key, &TomlMember::key);
        if (found == left_.end()) {
            return std::nullopt;
        }
        TomlNode node = std::move(found->node);
        left_.erase(found);
        return node;
    }

    template <typename Value>
    [[nodiscard]] std::optional<Value> take_as(std::string_view key, std::string_view kind)
    {
        auto node = take(key);
        if (!node) {
            return std::nullopt;
        }
        auto* value = std::get_if<Value>(&node->value);
        if (value == nullptr) {
            refuse(fmt::format("{} must be {}", key, kind));
        }
        return std::move(*value);
    }

    [[nodiscard]] std::string text(std::string_view key)
    {
        auto value = take_as<std::string>(key, "a text");
        if (!value || value->empty()) {
            refuse(fmt::format("{} is missing", key));
        }
        return *std::move(value);
    }

    [[nodiscard]] const std::string* peek_text(std::string_view key) const
    {
        const auto found = std::ranges::find(left_, key, &TomlMember::key);
        return found == left_.end() ? nullptr : std::get_if<std::string>(&found->node.value);
    }

    [[nodiscard]] std::optional<double> number(std::string_view key)
    {
        const auto node = take(key);
        if (!node) {
            return std::nullopt;
        }
        if (const auto* whole = std::get_if<std::int64_t>(&node->value)) {
            return static_cast<double>(*whole);
        }
        if (const auto* real = std::get_if<double>(&node->value)) {
            return *real;
        }
        refuse(fmt::format("{} must be a number", key));
    }

    void finish() const
    {
        if (!left_.empty()) {
            refuse(fmt::format("unknown member {}", left_.front().key));
        }
    }

private:
    std::string where_;
    TomlTable left_;
};

/// A number as a job writes it: whole ones without a point, so that integer keys take them.
TomlNode number_node(double value)
{
    const double whole = std::nearbyint(value);
    return whole == value && std::abs(value) < 1e9 ? TomlNode{static_cast<std::int64_t>(whole)}
                                                   : TomlNode{value};
}

/// The key's value where the engine's setting is at its own default.
TomlNode key_value(const EngineSetting& setting, const Members& members)
{
    if (const auto* number = std::get_if<double>(&*setting.own_default)) {
        return number_node(*number / setting.times);
    }
    const auto& word = std::get<std::string>(*setting.own_default);
    const auto found =
        std::ranges::find(setting.words, word, [](const auto& pair) { return pair.second; });
    if (found == setting.words.end()) {
        members.refuse(fmt::format("default {} is not among the words", word));
    }
    // A number among the words is one: "512" of a map's size.
    const auto number = parse_toml_value(found->first);
    return number && std::holds_alternative<std::int64_t>(number->value) ? *number
                                                                         : TomlNode{found->first};
}

const std::string& text_of(const TomlNode& node, std::string_view name, const Members& members)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr) {
        members.refuse(fmt::format("{} must be a text", name));
    }
    return *text;
}

void read_words(EngineSetting& setting, Members& members)
{
    const auto words = members.take_as<TomlTable>("words", "a table");
    for (const TomlMember& member : words.value_or(TomlTable{})) {
        setting.words.emplace(member.key, text_of(member.node, member.key, members));
    }
}

void read_conditions(const KeyTable& keys, EngineSetting& setting, Members& members)
{
    const auto conditions = members.take_as<TomlTable>("where", "a table");
    for (const TomlMember& member : conditions.value_or(TomlTable{})) {
        const Key* const key = keys.find(member.key);
        const auto* words = std::get_if<TomlArray>(&member.node.value);
        if (key == nullptr || words == nullptr) {
            members.refuse(fmt::format("where.{} must be a key with a list of words", member.key));
        }
        for (const TomlNode& word : *words) {
            setting.where[key].push_back(text_of(word, member.key, members));
        }
    }
}

EngineSetting read_setting(const KeyTable& keys, Members& members)
{
    EngineSetting setting;
    setting.name = members.text("name");
    setting.line = members.text("line");
    setting.about = members.take_as<std::string>("about", "a text").value_or("");
    const auto known_key = [&](const std::string& name) {
        const Key* const key = keys.find(name);
        if (key == nullptr) {
            members.refuse(fmt::format("there is no key {}", name));
        }
        return key;
    };
    setting.key = known_key(members.text("key"));
    if (const auto second = members.take_as<std::string>("second_key", "a text")) {
        setting.second_key = known_key(*second);
    }
    setting.times = members.number("times").value_or(setting.times);
    setting.least = members.number("least").value_or(setting.least);
    setting.most = members.number("most").value_or(setting.most);
    if (setting.times == 0) {
        members.refuse("times must not be 0");
    }
    if (const auto* word = members.peek_text("default")) {
        setting.own_default = *word;
        (void)members.take("default");
    } else if (const auto number = members.number("default")) {
        setting.own_default = *number;
    }
    read_words(setting, members);
    read_conditions(keys, setting, members);
    return setting;
}

} // namespace

bool EngineSetting::is_of(const Job& job) const
{
    return std::ranges::all_of(where, [&](const auto& condition) {
        const auto value = engine_key_value(*condition.first, job);
        return value &&
               std::ranges::find(condition.second, engine_word(*value)) != condition.second.end();
    });
}

std::optional<JobValue> engine_key_value(const Key& key, const Job& job)
{
    if (key.name == "shadow_map.layout") { // which a job may leave to its light
        return std::string{map_layout_name(map_layout(job))};
    }
    return key.is_added() ? std::optional{key.value_of(job.method)} : key.get(job);
}

std::string engine_word(const JobValue& value)
{
    const auto* word = std::get_if<std::string>(&value);
    return word != nullptr ? *word : to_toml(value);
}

ReadEngine read_engine(const KeyTable& keys, std::string_view preset, const TomlTable& table)
{
    ReadEngine read;
    Members members{fmt::format("preset {}: [engine]", preset), table};
    read.engine.title = members.text("title");
    read.engine.version = members.text("version");
    read.engine.documentation = members.text("documentation");
    read.engine.comment = members.text("comment");
    const auto settings = members.take_as<TomlArray>("settings", "a list of tables");
    const auto aliases = members.take_as<TomlArray>("aliases", "a list of names");
    for (const TomlNode& name : aliases.value_or(TomlArray{})) {
        read.engine.aliases.push_back(text_of(name, "aliases", members));
    }
    const auto also = members.take_as<TomlArray>("also", "a list of lines");
    for (const TomlNode& line : also.value_or(TomlArray{})) {
        read.engine.also.push_back(text_of(line, "also", members));
    }
    members.finish();
    for (const TomlNode& node : settings.value_or(TomlArray{})) {
        const auto* own = std::get_if<TomlTable>(&node.value);
        if (own == nullptr) {
            members.refuse("settings must be a list of tables");
        }
        Members of_setting{fmt::format("preset {}: [[engine.settings]]", preset), *own};
        EngineSetting setting = read_setting(keys, of_setting);
        if (setting.own_default) {
            read.job.push_back({setting.key->name, key_value(setting, of_setting)});
        }
        of_setting.finish();
        read.engine.settings.push_back(std::move(setting));
    }
    if (read.engine.settings.empty()) {
        members.refuse("settings is missing");
    }
    return read;
}

} // namespace gnomon::scene
