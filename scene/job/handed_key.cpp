#include "scene/job/handed_key.hpp"

#include <algorithm>

namespace gnomon::scene {

std::string_view HandedKey::table() const
{
    return std::string_view{key.name}.substr(0, key.name.rfind('.'));
}

bool HandedKey::is_of(std::string_view method) const
{
    return table() == "engine" || std::ranges::find(methods, method) != methods.end();
}

JobKey HandedKey::row() const
{
    JobKey row = key;
    row.default_text = to_toml(default_value);
    row.range_text = range_text(domain);
    return row;
}

const JobValue& HandedKey::value_of(const Job& job) const
{
    const auto found = job.method.values.find(key.name);
    return found == job.method.values.end() ? default_value : found->second;
}

} // namespace gnomon::scene
