#include "methods/method.hpp"

#include <algorithm>
#include <iterator>

namespace gnomon::methods {
namespace {

/// "bias" of "bias.constant".
std::string_view table_of(std::string_view key)
{
    return key.substr(0, key.rfind('.'));
}

} // namespace

std::vector<scene::JobKey> keys_of(const Method& method)
{
    std::vector<scene::JobKey> keys;
    std::ranges::copy_if(scene::job_keys(), std::back_inserter(keys), [&](const auto& key) {
        return std::ranges::find(method.key_tables, table_of(key.name)) != method.key_tables.end();
    });
    return keys;
}

Promises promises_with(const Method& method, scene::Filter filter)
{
    scene::Job job;
    job.lookup.filter = filter;
    return method.promises(job);
}

} // namespace gnomon::methods
