#include "scene/job/keys/key_table.hpp"

#include "scene/job/keys/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace gnomon::scene {

namespace {

using Methods = std::vector<MethodChoice>;

Key name_key(const Methods& methods, const std::string& default_name)
{
    WordDomain names;
    for (const MethodChoice& method : methods) {
        names.words.push_back(method.name);
    }
    return member_key<std::string>(
        make_key("method.name", "what decides verdicts; `gnomon methods` lists them",
                 to_toml(JobValue{default_name}), Stage::prefilter | Stage::lookup),
        std::move(names), [](auto& job) -> auto& { return job.method.name; });
}

const MethodChoice* find_method(const Methods& methods, std::string_view name)
{
    const auto found = std::ranges::find(methods, name, &MethodChoice::name);
    return found == methods.end() ? nullptr : &*found;
}

/// One of the layer `scene`'s own keys, limited to some methods.
Key row_of_methods(Key key, std::vector<std::string> having)
{
    key.get = [having, get = std::move(key.get)](const Job& job) {
        return std::ranges::find(having, job.method.name) == having.end() ? std::nullopt : get(job);
    };
    key.methods = std::move(having);
    return key;
}

/// An added key, stored among the values of the job's method.
Key added_row(Key key)
{
    key.set = [name = key.name](Job& job, const JobValue& value) {
        job.method.values[name] = value;
    };
    key.get = [name = key.name, is_bias = key.table() == "bias", methods = key.methods,
               default_value = *key.default_value](const Job& job) -> std::optional<JobValue> {
        if (methods && std::ranges::find(*methods, job.method.name) == methods->end()) {
            return std::nullopt;
        }
        const auto found = job.method.values.find(name);
        if (found != job.method.values.end()) {
            return found->second;
        }
        // A job does not list biases that it does not set.
        return is_bias ? std::nullopt : std::optional{default_value};
    };
    return key;
}

void check_added(const Key& key)
{
    if (key.table() != "method" && key.table() != "bias" && key.table() != "engine") {
        throw std::logic_error(
            fmt::format("KeyTable: {} is not of [method], [bias] or [engine]", key.name));
    }
    if (!key.is_added()) {
        throw std::logic_error(fmt::format("KeyTable: {} has no default", key.name));
    }
}

} // namespace

KeyTable::KeyTable() : KeyTable{{{Job{}.method.name, true}}, {}} {}

KeyTable::KeyTable(Methods methods, std::vector<Key> added)
    : methods_{std::move(methods)},
      added_{std::move(added)}
{
    if (methods_.empty()) {
        throw std::logic_error("KeyTable: there is no method");
    }
    std::ranges::for_each(added_, check_added);
    const auto add_shared = [&](const std::vector<Key>& keys) {
        for (const Key& key : keys) {
            rows_.push_back(shared_row(key));
        }
    };
    const auto add_those_of = [&](std::string_view table) {
        for (const Key& key : added_) {
            if (key.table() == table) {
                rows_.push_back(added_row(key));
            }
        }
    };
    add_shared(look_keys());
    add_shared({name_key(methods_, default_method())});
    add_those_of("method");
    add_shared(map_keys());
    add_those_of("bias");
    add_those_of("engine");
    for (const Key& row : rows_) {
        if (!by_name_.emplace(row.name, &row).second) {
            throw std::logic_error(fmt::format("KeyTable: {} repeats", row.name));
        }
    }
}

Key KeyTable::shared_row(Key key) const
{
    std::vector<std::string> having;
    for (const MethodChoice& method : methods_) {
        if (has_key(method.name, key.name)) {
            having.push_back(method.name);
        }
    }
    key.range_text = range_text(key.domain);
    return having.size() == methods_.size() ? key
                                            : row_of_methods(std::move(key), std::move(having));
}

Keys KeyTable::with_engine_keys(std::vector<Key> engine) const
{
    std::vector<Key> all = added_;
    std::ranges::move(engine, std::back_inserter(all));
    return std::make_shared<const KeyTable>(methods_, std::move(all));
}

const Key* KeyTable::find(std::string_view name) const
{
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second;
}

bool KeyTable::has_table(std::string_view name) const
{
    const std::string prefix = std::string{name} + ".";
    return std::ranges::any_of(rows_, [&](const Key& row) { return row.name.starts_with(prefix); });
}

const std::string& KeyTable::default_method() const
{
    const MethodChoice* depth = find_method(methods_, Job{}.method.name);
    return depth == nullptr ? methods_.front().name : depth->name;
}

bool KeyTable::has_filters(std::string_view method) const
{
    const MethodChoice* found = find_method(methods_, method);
    return found != nullptr && found->has_filters;
}

bool KeyTable::has_key(std::string_view method, std::string_view key) const
{
    if (key == "lookup.filter") {
        return has_filters(method);
    }
    const MethodChoice* found = find_method(methods_, method);
    return found == nullptr ||
           std::ranges::find(found->unread_tables, key.substr(0, key.find('.'))) ==
               found->unread_tables.end();
}

const Keys& own_keys()
{
    static const Keys own = std::make_shared<const KeyTable>();
    return own;
}

const Keys& key_table_of(const Job& job)
{
    return job.keys == nullptr ? own_keys() : job.keys;
}

const KeyTable& keys_of(const Job& job)
{
    return *key_table_of(job);
}

std::optional<JobValue> default_of(const Key& key, const Job& job)
{
    if (key.is_added()) {
        return key.default_value;
    }
    Job defaults;
    defaults.method.name = job.method.name;
    defaults.shadow_map.layout = map_layout(job);
    return key.get(defaults);
}

std::optional<JobValue> value_in(const Key& key, const Job& job)
{
    return key.is_added() ? std::optional{key.value_of(job.method)} : key.get(job);
}

std::vector<std::pair<std::string, std::string>> resolved_keys(const Job& job)
{
    std::vector<std::pair<std::string, std::string>> resolved;
    for (const Key& row : keys_of(job).rows()) {
        if (const auto value = row.get(job)) {
            resolved.emplace_back(row.name, to_toml(*value));
        }
    }
    return resolved;
}

bool has_filters(const Job& job)
{
    return keys_of(job).has_filters(job.method.name);
}

bool has_key(const Job& job, std::string_view key)
{
    return keys_of(job).has_key(job.method.name, key);
}

const JobValue* find_added_value(const Job& job, std::string_view name)
{
    const Key* key = keys_of(job).find(name);
    return key != nullptr && key->is_added() && key->is_of(job.method.name)
               ? &key->value_of(job.method)
               : nullptr;
}

bool is_engine_key(std::string_view name)
{
    constexpr std::string_view table = "engine";
    return name.starts_with(table) && (name.size() == table.size() || name[table.size()] == '.');
}

} // namespace gnomon::scene
