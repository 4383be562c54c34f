#include "methods/key_table.hpp"

#include "methods/list.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::methods {

namespace {

/// The shared tables of which the method has no key.
std::vector<std::string> unread_tables(const Method& method)
{
    std::vector<std::string> unread;
    for (const std::string_view table : {"shadow_map", "lookup", "bias"}) {
        if (std::ranges::find(method.key_tables, table) == method.key_tables.end()) {
            unread.emplace_back(table);
        }
    }
    return unread;
}

bool is_same_row(const scene::Key& a, const scene::Key& b)
{
    return a.description == b.description && a.unit == b.unit && a.range_text == b.range_text &&
           a.default_text == b.default_text && a.stages == b.stages &&
           a.tried.values == b.tried.values && a.tried.unit == b.tried.unit;
}

/// The keys of all methods, each once, with the names of its methods.
std::vector<scene::Key> all_keys()
{
    std::vector<scene::Key> all;
    for (const Method& method : methods()) {
        for (const scene::Key& key : own_keys(method)) {
            const auto same = std::ranges::find(all, key.name, &scene::Key::name);
            if (same != all.end() && !is_same_row(*same, key)) {
                throw std::invalid_argument(
                    fmt::format("methods: {} of {} is another key than that of another method",
                                key.name, method.name));
            }
            auto& of = same == all.end() ? all.emplace_back(key) : *same;
            of.methods->emplace_back(method.name);
        }
    }
    return all;
}

scene::Keys make_table()
{
    std::vector<scene::MethodChoice> all;
    for (const Method& method : methods()) {
        all.push_back({std::string{method.name}, !method.filters.empty(), unread_tables(method)});
    }
    for (const Method& method : methods()) {
        check(method.bias_terms);
    }
    return std::make_shared<const scene::KeyTable>(std::move(all), all_keys());
}

} // namespace

const scene::Keys& key_table()
{
    static const scene::Keys table = make_table();
    return table;
}

} // namespace gnomon::methods
