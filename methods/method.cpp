#include "methods/method.hpp"

#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <algorithm>
#include <iterator>

namespace gnomon::methods {

namespace {

/// The table of a key: "bias" for "bias.constant".
std::string_view table_of(std::string_view key)
{
    return key.substr(0, key.rfind('.'));
}

} // namespace

std::vector<scene::Key> own_keys(const Method& method)
{
    std::vector<scene::Key> keys = method.keys;
    for (const BiasTerm& term : method.bias_terms) {
        if (term.own_keys != nullptr) {
            std::ranges::copy(term.own_keys(), std::back_inserter(keys));
        }
    }
    return keys;
}

std::vector<scene::Key> keys_of(const Method& method)
{
    std::vector<scene::Key> keys;
    for (const scene::Key& spec : scene::own_keys()->rows()) {
        const std::string& name = spec.name;
        const bool is_read =
            std::ranges::find(method.key_tables, table_of(name)) != method.key_tables.end();
        if (is_read && (name != "lookup.filter" || !method.filters.empty())) {
            keys.push_back(spec);
        }
    }
    for (const scene::Key& own : own_keys(method)) {
        keys.push_back(own);
    }
    return keys;
}

LookupTraits traits_with(const Method& method, scene::Filter filter)
{
    scene::Job job;
    job.lookup.filter = filter;
    return method.traits(job);
}

} // namespace gnomon::methods
