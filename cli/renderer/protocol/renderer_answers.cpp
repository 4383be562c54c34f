#include "cli/renderer/protocol/renderer_answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <variant>

namespace gnomon::cli {
namespace {

constexpr std::size_t longest_name = 40;      ///< also of keys, types and units [bytes]
constexpr std::size_t longest_version = 32;   ///< [bytes]
constexpr std::size_t longest_device = 124;   ///< [bytes]; the three make up a case's `renderer`
constexpr std::size_t longest_sentence = 400; ///< [bytes]
constexpr std::size_t most_keys = 500;
/// No integer in a job is larger.
constexpr std::int64_t largest_integer = 1'000'000'000'000;

bool is_key_name(std::string_view name)
{
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    return !name.empty() && is_letter(name.front()) && std::ranges::all_of(name, [&](char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
    });
}

/// Both ends of `range`.
template <typename Number>
std::pair<Number, Number> read_range(const AnswerObject& key, Number largest)
{
    const AnswerJson& range = key.at("range");
    const bool is_pair =
        range.is_array() && range.size() == 2 && range[0].is_number() && range[1].is_number();
    const auto is_whole = [](const AnswerJson& number) {
        return std::is_same_v<Number, double> || number.is_number_integer();
    };
    if (!is_pair || !is_whole(range[0]) || !is_whole(range[1])) {
        throw BadAnswer(fmt::format("{} is {}; it must be two numbers of the key's type",
                                    key.name_of("range"), answer_excerpt(range)));
    }
    const auto lower = range[0].get<Number>();
    const auto upper = range[1].get<Number>();
    if (!(-largest <= lower && lower <= upper && upper <= largest)) {
        throw BadAnswer(fmt::format("{} is {}; it must be [least, most], within ±{}",
                                    key.name_of("range"), answer_excerpt(range), largest));
    }
    return {lower, upper};
}

scene::WordDomain read_words(const AnswerObject& key)
{
    const AnswerJson& values = key.at("values");
    scene::WordDomain domain;
    for (const AnswerJson& value : values.is_array() ? values : AnswerJson::array()) {
        const auto* const word = value.get_ptr<const std::string*>();
        if (word != nullptr && !word->empty() && said_excerpt(*word) == *word) {
            domain.words.push_back(*word);
        }
    }
    std::vector<std::string> sorted = domain.words;
    std::ranges::sort(sorted);
    if (sorted.empty() || sorted.size() != values.size() ||
        std::ranges::adjacent_find(sorted) != sorted.end()) {
        throw BadAnswer(fmt::format("{} is {}; it must be a list of different words",
                                    key.name_of("values"), answer_excerpt(values)));
    }
    return domain;
}

scene::Domain read_domain(const AnswerObject& key)
{
    const std::string type = key.text("type", longest_name);
    if (type == "boolean") {
        return scene::FlagDomain{};
    }
    if (type == "choice") {
        return read_words(key);
    }
    if (type == "number") {
        const auto [lower, upper] = read_range<double>(key, scene::farthest_m);
        return scene::RealDomain{.lower = lower, .upper = upper};
    }
    if (type == "integer") {
        const auto [lower, upper] = read_range<std::int64_t>(key, largest_integer);
        return scene::IntegerDomain{lower, upper};
    }
    throw BadAnswer(fmt::format("{} is \"{}\"; it must be number, integer, boolean or choice",
                                key.name_of("type"), said_excerpt(type)));
}

/// Converts a scalar to TOML.
scene::TomlNode node_of(const AnswerJson& value)
{
    if (value.is_boolean()) {
        return {value.get<bool>()};
    }
    if (value.is_number_integer()) {
        return {value.get<std::int64_t>()};
    }
    if (value.is_number()) {
        return {value.get<double>()};
    }
    return value.is_string() ? scene::TomlNode{value.get<std::string>()} : scene::TomlNode{};
}

EngineKey read_key(const AnswerObject& key)
{
    key.require_only({"name", "type", "range", "values", "default", "unit", "help"});
    EngineKey read;
    read.name = key.text("name", longest_name);
    if (!is_key_name(read.name)) {
        throw BadAnswer(fmt::format("{} is \"{}\"; it must be a letter, then letters, digits and _",
                                    key.name_of("name"), said_excerpt(read.name)));
    }
    read.domain = read_domain(key);
    const auto value = scene::read_value(read.domain, node_of(key.at("default")));
    if (!value) {
        throw BadAnswer(fmt::format("{} of \"{}\" is {}: it {}", key.name_of("default"), read.name,
                                    answer_excerpt(key.at("default")),
                                    scene::refusal_text(read.domain, node_of(key.at("default")))));
    }
    read.default_value = *value;
    const bool is_of_no_unit =
        !key.has("unit") ||
        (key.at("unit").is_string() && key.at("unit").get_ref<const std::string&>().empty());
    if (!is_of_no_unit) {
        read.unit = key.text("unit", longest_name);
    }
    read.help = key.text("help", longest_sentence);
    return read;
}

void require_ok(const AnswerObject& answer)
{
    if (answer.at("ok") != true) {
        throw BadAnswer(
            fmt::format("ok is {}; it must be true; if the request failed, answer with `error`",
                        answer_excerpt(answer.at("ok"))));
    }
}

std::string sentence_of(const AnswerJson& json)
{
    if (!json.is_string() || json.get<std::string>().empty()) {
        throw BadAnswer(
            fmt::format("error is {}; it must be a sentence, or sentences by the keys that cannot "
                        "be done",
                        answer_excerpt(json)));
    }
    return said_excerpt(json.get<std::string>(), longest_sentence);
}

} // namespace

std::string RendererHello::title() const
{
    return fmt::format("{} {}, {}", name, version, device);
}

const std::vector<std::string_view>& answered_tables()
{
    static const std::vector<std::string_view> tables{"shadow_map", "lookup",  "bias", "method",
                                                      "channels",   "objects", "map"};
    return tables;
}

RendererHello read_hello(const AnswerJson& json)
{
    const AnswerObject answer{json, ""};
    const std::int64_t protocol = answer.integer("protocol");
    if (protocol != protocol_version) {
        throw BadAnswer(
            fmt::format("protocol is {}; this Gnomon speaks {}", protocol, protocol_version));
    }
    answer.require_only({"id", "protocol", "name", "version", "device", "keys"});
    RendererHello hello;
    hello.name = answer.text("name", longest_name);
    hello.version = answer.text("version", longest_version);
    hello.device = answer.text("device", longest_device);
    const AnswerJson& keys = answer.at("keys");
    if (!keys.is_array() || keys.size() > most_keys) {
        throw BadAnswer(fmt::format("keys is {}; it must be a list of at most {} keys",
                                    answer_excerpt(keys), most_keys));
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
        EngineKey key = read_key({keys[i], fmt::format("keys[{}]", i)});
        if (std::ranges::find(hello.keys, key.name, &EngineKey::name) != hello.keys.end()) {
            throw BadAnswer(fmt::format("keys has \"{}\" twice", key.name));
        }
        hello.keys.push_back(std::move(key));
    }
    return hello;
}

AnswerJson read_opened(const AnswerJson& json)
{
    const AnswerObject answer{json, ""};
    require_ok(answer);
    answer.require_only({"id", "ok", "conventions"});
    if (!answer.has("conventions")) {
        return AnswerJson::object();
    }
    (void)AnswerObject{answer.at("conventions"), "conventions"};
    return answer.at("conventions");
}

DrawnAnswer read_drawn(const AnswerJson& json)
{
    const AnswerObject answer{json, ""};
    require_ok(answer);
    answer.require_only({"id", "ok", "seconds", "files", "case"});
    DrawnAnswer drawn;
    drawn.seconds = answer.number("seconds");
    if (drawn.seconds < 0) {
        throw BadAnswer(fmt::format("seconds is {}; it must not be negative", drawn.seconds));
    }
    if (answer.has("files")) {
        const AnswerJson& files = answer.at("files");
        const AnswerObject named{files, "files"};
        for (const auto& [key, file] : files.items()) {
            drawn.files[key] = named.text(key, longest_sentence);
        }
    }
    if (answer.has("case")) {
        drawn.tables = answer.at("case");
        const AnswerObject tables{drawn.tables, "case"};
        tables.require_only(answered_tables());
        for (const auto& [name, table] : drawn.tables.items()) {
            (void)AnswerObject{table, tables.name_of(name)};
        }
    }
    return drawn;
}

std::vector<std::pair<std::string, std::string>> read_errors(const AnswerJson& answer)
{
    std::vector<std::pair<std::string, std::string>> errors;
    const auto found = answer.find("error");
    if (found == answer.end()) {
        return errors;
    }
    if (!found->is_object() || found->empty()) {
        errors.emplace_back("", sentence_of(*found));
        return errors;
    }
    for (const auto& [key, sentence] : found->items()) {
        errors.emplace_back(said_excerpt(key), sentence_of(sentence));
    }
    return errors;
}

AnswerJson to_json(const scene::JobValue& value)
{
    struct ToJson {
        AnswerJson operator()(bool flag) const { return flag; }
        AnswerJson operator()(std::int64_t number) const { return number; }
        AnswerJson operator()(double number) const { return number; }
        AnswerJson operator()(const std::string& text) const { return text; }
        AnswerJson operator()(const std::vector<std::string>& texts) const { return texts; }
        AnswerJson operator()(const scene::Vec3d& v) const { return {v.x, v.y, v.z}; }
    };
    return std::visit(ToJson{}, value);
}

} // namespace gnomon::cli
