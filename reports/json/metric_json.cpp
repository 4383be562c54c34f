#include "reports/json/metric_json.hpp"

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

namespace gnomon::reports {

namespace {

std::optional<std::size_t> index_in_array(std::string_view part)
{
    if (part == "lo" || part == "hi") {
        return part == "lo" ? 0 : 1;
    }
    std::size_t index = 0;
    const char* const end = part.data() + part.size();
    const auto [stop, error] = std::from_chars(part.data(), end, index);
    return error == std::errc{} && stop == end ? std::optional{index} : std::nullopt;
}

} // namespace

store::Json& member_at(store::Json& json, std::string_view name)
{
    store::Json* found = &json;
    while (!name.empty()) {
        const std::string_view part = name.substr(0, name.find('.'));
        name.remove_prefix(part.size() == name.size() ? part.size() : part.size() + 1);
        const auto index = index_in_array(part);
        found = index ? &(*found)[*index] : &(*found)[std::string{part}];
    }
    return *found;
}

store::Json value_json(const analysis::MetricValue& value)
{
    return std::visit(
        [](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) {
                return store::Json(nullptr);
            } else {
                return store::Json(held);
            }
        },
        value);
}

} // namespace gnomon::reports
