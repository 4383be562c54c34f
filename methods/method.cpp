#include "methods/method.hpp"

#include "methods/list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace gnomon::methods {
namespace {

/// "bias" of "bias.constant".
std::string_view table_of(std::string_view key)
{
    return key.substr(0, key.rfind('.'));
}

/// The keys of all methods, each once, with the names of all methods that have it.
std::vector<scene::HandedKey> all_keys()
{
    std::vector<scene::HandedKey> all;
    for (const Method& method : methods()) {
        for (const scene::HandedKey& key : method.keys) {
            const auto same = std::ranges::find(
                all, key.key.name, [](const scene::HandedKey& known) { return known.key.name; });
            auto& of = same == all.end() ? all.emplace_back(key) : *same;
            of.methods.emplace_back(method.name);
        }
    }
    return all;
}

} // namespace

std::vector<scene::JobKey> keys_of(const Method& method)
{
    std::vector<scene::JobKey> keys;
    std::ranges::copy_if(scene::job_keys(), std::back_inserter(keys), [&](const auto& key) {
        const bool is_read =
            std::ranges::find(method.key_tables, table_of(key.name)) != method.key_tables.end();
        return is_read && (key.name != "lookup.filter" || !method.filters.empty());
    });
    for (const scene::HandedKey& own : method.keys) {
        keys.push_back(own.row());
    }
    return keys;
}

Promises promises_with(const Method& method, scene::Filter filter)
{
    scene::Job job;
    job.lookup.filter = filter;
    return method.promises(job);
}

const Method* find_method(std::string_view name)
{
    const auto all = methods();
    const auto found = std::ranges::find(all, name, &Method::name);
    return found == all.end() ? nullptr : &*found;
}

const Method& method_of(const scene::Job& job)
{
    const Method* method = find_method(job.method.name);
    if (method == nullptr) {
        throw std::invalid_argument(
            fmt::format("method_of: there is no method {}", job.method.name));
    }
    return *method;
}

Promises promises(const scene::Job& job)
{
    return method_of(job).promises(job);
}

void check(const scene::Job& job)
{
    const Method& method = method_of(job);
    if (method.check != nullptr) {
        method.check(job);
    }
}

Passes passes(const scene::Job& job)
{
    return method_of(job).passes(job);
}

void hand_keys_to_scene()
{
    std::vector<scene::HandedMethod> all;
    for (const Method& method : methods()) {
        all.push_back({std::string{method.name}, !method.filters.empty()});
    }
    scene::hand_over_methods(std::move(all), all_keys());
}

} // namespace gnomon::methods
