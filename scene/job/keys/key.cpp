#include "scene/job/keys/key.hpp"

#include "scene/settings/job.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::scene {

std::string_view Key::table() const
{
    return std::string_view{name}.substr(0, name.rfind('.'));
}

bool Key::is_of(std::string_view method) const
{
    return !methods || std::ranges::find(*methods, method) != methods->end();
}

bool Key::is_of(LightType light) const
{
    return lights.empty() || std::ranges::find(lights, light) != lights.end();
}

const JobValue& Key::value_of(const MethodSettings& method) const
{
    const auto found = method.values.find(name);
    return found == method.values.end() ? default_value.value() : found->second;
}

std::string_view key_leaf(std::string_view name)
{
    return name.substr(name.rfind('.') + 1); // rfind gives npos, and npos + 1 = 0, without a dot
}

Key make_key(std::string name, std::string description, std::string default_text, Stages stages,
             std::string unit)
{
    constexpr std::string_view place = "{unit}";
    if (const auto found = description.find(place); found != std::string::npos) {
        description.replace(found, place.size(), unit);
    }
    Key key;
    key.name = std::move(name);
    key.description = std::move(description);
    key.unit = std::move(unit);
    key.default_text = std::move(default_text);
    key.stages = stages;
    return key;
}

Key added_key(Key key, Domain domain, JobValue default_value, TriedValues tried,
              std::vector<std::string> methods)
{
    key.default_text = to_toml(default_value);
    key.range_text = range_text(domain);
    key.domain = std::move(domain);
    key.default_value = std::move(default_value);
    key.tried = std::move(tried);
    if (key.table() != "engine") {
        key.methods = std::move(methods);
    }
    return key;
}

} // namespace gnomon::scene
