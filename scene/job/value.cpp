#include "scene/job/value.hpp"

#include "scene/light/sun.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace gnomon::scene {
namespace {

/// The node as a number, whether written as an integer or a float.
std::optional<double> as_number(const TomlNode& node)
{
    if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
        return static_cast<double>(*integer);
    }
    if (const double* real = std::get_if<double>(&node.value)) {
        return *real;
    }
    return std::nullopt;
}

std::string range_of(const FlagDomain&)
{
    return "true or false";
}
std::string range_of(const IntegerDomain& domain)
{
    if (domain.is_power_of_two) {
        return fmt::format("a power of two from {} to {}", domain.lower, domain.upper);
    }
    return fmt::format("an {}integer from {} to {}", domain.step == 2 ? "odd " : "", domain.lower,
                       domain.upper);
}
std::string range_of(const RealDomain& domain)
{
    return fmt::format("{}a number from {} to {}{}", domain.or_auto ? "\"auto\" or " : "",
                       toml_number(domain.lower), toml_number(domain.upper),
                       domain.normal_float ? ", 0 or at least 1.18e-38 in size (not subnormal)"
                                           : "");
}
std::string range_of(const WordDomain& domain)
{
    return "one of " + (domain.listing.empty() ? fmt::format("{}", fmt::join(domain.words, ", "))
                                               : domain.listing);
}
std::string range_of(const TextDomain&)
{
    return "a text that is not empty";
}
std::string range_of(const TextListDomain&)
{
    return "a list of texts";
}
std::string range_of(const TimeDomain&)
{
    return fmt::format("a time from {} to {} with Z or an offset at its end, such as "
                       "\"2026-06-21T12:00:00Z\"",
                       first_sun_year, last_sun_year);
}
std::string range_of(const VectorDomain& domain)
{
    return fmt::format("{} from {} to {}{}",
                       domain.size == 2 ? "two numbers [a, b]" : "three numbers [x, y, z]",
                       toml_number(-farthest_m), toml_number(farthest_m),
                       domain.zero_allowed ? "" : ", not all 0");
}

std::optional<JobValue> value_in(const FlagDomain&, const TomlNode& node)
{
    const bool* flag = std::get_if<bool>(&node.value);
    return flag != nullptr ? std::optional<JobValue>{*flag} : std::nullopt;
}

std::optional<JobValue> value_in(const IntegerDomain& domain, const TomlNode& node)
{
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    if (integer == nullptr || *integer < domain.lower || *integer > domain.upper ||
        (*integer - domain.lower) % domain.step != 0) {
        return std::nullopt;
    }
    if (domain.is_power_of_two && !std::has_single_bit(static_cast<std::uint64_t>(*integer))) {
        return std::nullopt;
    }
    return *integer;
}

std::optional<JobValue> value_in(const RealDomain& domain, const TomlNode& node)
{
    const auto* word = std::get_if<std::string>(&node.value);
    if (domain.or_auto && word != nullptr && *word == "auto") {
        return *word;
    }
    const auto number = as_number(node);
    // Written so that NaN fails.
    if (!number || !(*number >= domain.lower && *number <= domain.upper)) {
        return std::nullopt;
    }
    const bool is_normal =
        std::abs(static_cast<float>(*number)) >= std::numeric_limits<float>::min();
    if (domain.normal_float && *number != 0 && !is_normal) {
        return std::nullopt;
    }
    return *number;
}

std::optional<JobValue> value_in(const WordDomain& domain, const TomlNode& node)
{
    const auto* word = std::get_if<std::string>(&node.value);
    if (word == nullptr ||
        std::find(domain.words.begin(), domain.words.end(), *word) == domain.words.end()) {
        return std::nullopt;
    }
    return *word;
}

/// Texts are names or paths, which cannot hold a NUL.
const std::string* as_text(const TomlNode& node)
{
    const auto* text = std::get_if<std::string>(&node.value);
    const bool is_usable =
        text != nullptr && !text->empty() && text->find('\0') == std::string::npos;
    return is_usable ? text : nullptr;
}

std::optional<JobValue> value_in(const TextDomain&, const TomlNode& node)
{
    const std::string* text = as_text(node);
    return text != nullptr ? std::optional<JobValue>{*text} : std::nullopt;
}

std::optional<JobValue> value_in(const TextListDomain&, const TomlNode& node)
{
    const auto* array = std::get_if<TomlArray>(&node.value);
    if (array == nullptr) {
        return std::nullopt;
    }
    std::vector<std::string> texts;
    for (const TomlNode& element : *array) {
        const std::string* text = as_text(element);
        if (text == nullptr) {
            return std::nullopt;
        }
        texts.push_back(*text);
    }
    return texts;
}

std::optional<JobValue> value_in(const TimeDomain&, const TomlNode& node)
{
    const auto* toml = std::get_if<TomlTime>(&node.value);
    const std::string* text = toml != nullptr ? &toml->text : as_text(node);
    const auto time = text != nullptr ? utc_time(*text) : std::nullopt;
    return time && has_sun(*time) ? std::optional<JobValue>{*text} : std::nullopt;
}

std::optional<JobValue> value_in(const VectorDomain& domain, const TomlNode& node)
{
    const auto* array = std::get_if<TomlArray>(&node.value);
    if (array == nullptr || array->size() != domain.size) {
        return std::nullopt;
    }
    std::array<double, 3> xyz{};
    bool is_zero = true;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const auto number = as_number((*array)[i]);
        if (!number || !(std::abs(*number) <= farthest_m)) {
            return std::nullopt;
        }
        xyz[i] = *number;
        is_zero = is_zero && static_cast<float>(*number) == 0.0F;
    }
    if (is_zero && !domain.zero_allowed) {
        return std::nullopt;
    }
    return Vec3d{xyz[0], xyz[1], xyz[2]};
}

std::string text_of(bool flag)
{
    return flag ? "true" : "false";
}
std::string text_of(std::int64_t integer)
{
    return fmt::format("{}", integer);
}
std::string text_of(double number)
{
    return toml_number(number);
}
std::string text_of(const std::string& text)
{
    return toml_quoted(text);
}
std::string text_of(const std::vector<std::string>& texts)
{
    std::vector<std::string> quoted;
    for (const std::string& text : texts) {
        quoted.push_back(toml_quoted(text));
    }
    return fmt::format("[{}]", fmt::join(quoted, ", "));
}
std::string text_of(const Vec3d& v)
{
    return fmt::format("[{}, {}, {}]", toml_number(v.x), toml_number(v.y), toml_number(v.z));
}

} // namespace

std::string range_text(const Domain& domain)
{
    return std::visit([](const auto& one) { return range_of(one); }, domain);
}

std::optional<JobValue> read_value(const Domain& domain, const TomlNode& node)
{
    return std::visit([&](const auto& one) { return value_in(one, node); }, domain);
}

std::string refusal_text(const Domain& domain, const TomlNode& node)
{
    const auto* words = std::get_if<WordDomain>(&domain);
    const auto* word = std::get_if<std::string>(&node.value);
    std::string text = "must be " + range_text(domain);
    if (words == nullptr || word == nullptr) {
        return text;
    }
    return fmt::format("{}; the nearest is \"{}\"", text, nearest_word(*word, words->words));
}

std::string to_toml(const JobValue& value)
{
    return std::visit([](const auto& one) { return text_of(one); }, value);
}

} // namespace gnomon::scene
