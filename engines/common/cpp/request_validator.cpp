#include "cpp/request_validator.hpp"

#include <algorithm>
#include <utility>

namespace engine {
namespace {

/// Keys that every draw has, or that the map's camera already implies.
constexpr auto always_said = {"shadow_map.resolution",
                              "shadow_map.near",
                              "shadow_map.far",
                              "shadow_map.light_clip_from_world",
                              "shadow_map.vertical_fov_deg",
                              "shadow_map.half_extent",
                              "shadow_map.light_camera",
                              "shadow_map.maps"};

bool asks_for_nothing(const std::string& table, const Json& value)
{
    return table == "bias" && (value == "off" || (value.is_number() && value == 0));
}

std::string list_of(const std::vector<Json>& values)
{
    std::string text;
    for (const Json& value : values) {
        text += text.empty() ? "" : " or ";
        text += value.dump();
    }
    return text;
}

} // namespace

RequestValidator::RequestValidator(const Json& draw, std::string engine_name)
    : draw_{draw},
      engine_name_{std::move(engine_name)}
{
    taken_.insert(always_said.begin(), always_said.end());
}

const Json* RequestValidator::said(std::string_view key) const
{
    const auto dot = key.find('.');
    const auto table = draw_.find(std::string{key.substr(0, dot)});
    if (table == draw_.end()) {
        return nullptr;
    }
    const auto found = table->find(std::string{key.substr(dot + 1)});
    return found != table->end() ? &*found : nullptr;
}

void RequestValidator::allow(std::string_view key, const std::vector<Json>& values,
                             std::string_view why)
{
    const Json* const value = said(key);
    if (value != nullptr && std::ranges::find(values, *value) == values.end()) {
        refuse(key, std::string{why} +
                        (values.empty() ? "" : "; only " + list_of(values) + " is supported"));
    }
    accept(key);
}

void RequestValidator::accept(std::string_view key)
{
    taken_.emplace(key);
}

void RequestValidator::refuse(std::string_view key, std::string_view why)
{
    problems_[std::string{key}] = why;
}

void RequestValidator::finish()
{
    for (const char* const table : {"shadow_map", "lookup", "bias", "method"}) {
        const auto found = draw_.find(table);
        if (found == draw_.end()) {
            continue;
        }
        for (const auto& [name, value] : found->items()) {
            const std::string key = std::string{table} + "." + name;
            if (!taken_.contains(key) && !asks_for_nothing(table, value)) {
                refuse(key, engine_name_ + " has no such setting");
            }
        }
    }
    if (!problems_.empty()) {
        throw Refusal{problems_};
    }
}

} // namespace engine
