#include "scene/job/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::scene {

namespace {

using Methods = std::vector<HandedMethod>;

KeySpec name_key(const Methods& methods, const std::string& default_name)
{
    WordDomain names;
    for (const HandedMethod& method : methods) {
        names.words.push_back(method.name);
    }
    return member_key<std::string>(
        make_key("method.name", "what decides verdicts; `gnomon methods` lists them",
                 to_toml(JobValue{default_name}), Stage::prefilter | Stage::lookup),
        std::move(names), [](auto& job) -> auto& { return job.method.name; });
}

const HandedMethod* find_method(const Methods& methods, std::string_view name)
{
    const auto found = std::ranges::find(methods, name, &HandedMethod::name);
    return found == methods.end() ? nullptr : &*found;
}

bool has_filters_in(const Methods& methods, std::string_view method)
{
    const HandedMethod* found = find_method(methods, method);
    return found != nullptr && found->has_filters;
}

bool has_key_in(const Methods& methods, std::string_view method, std::string_view key)
{
    if (key == "lookup.filter") {
        return has_filters_in(methods, method);
    }
    const HandedMethod* found = find_method(methods, method);
    return found == nullptr ||
           std::ranges::find(found->unread_tables, key.substr(0, key.find('.'))) ==
               found->unread_tables.end();
}

/// A row of the scene's own, which jobs of some methods lack.
KeySpec shared_row(KeySpec spec, const std::shared_ptr<const Methods>& methods)
{
    spec.key.range_text = range_text(spec.domain);
    spec.is_of = [methods, name = spec.key.name](std::string_view method) {
        return has_key_in(*methods, method, name);
    };
    spec.get = [is_of = spec.is_of, get = std::move(spec.get)](const Job& job) {
        return is_of(job.method.name) ? get(job) : std::nullopt;
    };
    return spec;
}

KeySpec handed_row(const HandedKey& handed_key)
{
    return {.key = handed_key.row(),
            .domain = handed_key.domain,
            .set = [name = handed_key.key.name](
                       Job& job, const JobValue& value) { job.method.values[name] = value; },
            .get = [handed_key](const Job& job) -> std::optional<JobValue> {
                // A job says nothing of a bias that it does not set.
                const bool is_left_out = handed_key.table() == "bias" &&
                                         !job.method.values.contains(handed_key.key.name);
                return handed_key.is_of(job.method.name) && !is_left_out
                           ? std::optional{handed_key.value_of(job)}
                           : std::nullopt;
            },
            .is_of = [handed_key](std::string_view method) { return handed_key.is_of(method); },
            .example = {}};
}

void check_handed(const Methods& methods, const std::vector<HandedKey>& handed)
{
    if (methods.empty()) {
        throw std::logic_error("KeyTable: there is no method");
    }
    for (auto key = handed.begin(); key != handed.end(); ++key) {
        const std::string& name = key->key.name;
        if (key->table() != "method" && key->table() != "bias" && key->table() != "engine") {
            throw std::logic_error(
                fmt::format("KeyTable: {} is not of [method], [bias] or [engine]", name));
        }
        if (std::ranges::any_of(handed.begin(), key, [&](const HandedKey& earlier) {
                return earlier.key.name == name;
            })) {
            throw std::logic_error(fmt::format("KeyTable: {} repeats", name));
        }
    }
}

} // namespace

KeyTable::KeyTable() : KeyTable{{{Job{}.method.name, true}}, {}} {}

KeyTable::KeyTable(Methods methods, std::vector<HandedKey> handed)
    : methods_{std::make_shared<const Methods>(std::move(methods))},
      handed_{std::move(handed)}
{
    check_handed(*methods_, handed_);
    const auto add_shared = [&](const std::vector<KeySpec>& specs) {
        for (const KeySpec& spec : specs) {
            rows_.push_back(shared_row(spec, methods_));
        }
    };
    const auto add_handed = [&](std::string_view table) {
        for (const HandedKey& key : handed_) {
            if (key.table() == table) {
                rows_.push_back(handed_row(key));
            }
        }
    };
    add_shared(look_key_specs());
    add_shared({name_key(*methods_, default_method())});
    add_handed("method");
    add_shared(map_key_specs());
    add_handed("bias");
    add_handed("engine");
    for (const KeySpec& row : rows_) {
        by_name_.emplace(row.key.name, &row);
    }
}

Keys KeyTable::with(std::vector<HandedKey> engine) const
{
    std::vector<HandedKey> all = handed_;
    std::ranges::move(engine, std::back_inserter(all));
    return std::make_shared<const KeyTable>(*methods_, std::move(all));
}

const KeySpec* KeyTable::find(std::string_view name) const
{
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second;
}

bool KeyTable::has_table(std::string_view name) const
{
    const std::string prefix = std::string{name} + ".";
    return std::ranges::any_of(
        rows_, [&](const KeySpec& row) { return row.key.name.starts_with(prefix); });
}

const HandedKey* KeyTable::find_handed(std::string_view name) const
{
    const auto found =
        std::ranges::find_if(handed_, [&](const HandedKey& key) { return key.key.name == name; });
    return found == handed_.end() ? nullptr : &*found;
}

const std::string& KeyTable::default_method() const
{
    const HandedMethod* depth = find_method(*methods_, Job{}.method.name);
    return depth == nullptr ? methods_->front().name : depth->name;
}

bool KeyTable::has_filters(std::string_view method) const
{
    return has_filters_in(*methods_, method);
}

bool KeyTable::has_key(std::string_view method, std::string_view key) const
{
    return has_key_in(*methods_, method, key);
}

bool KeyTable::has_any_key(std::string_view method, std::string_view key) const
{
    const HandedKey* own = find_handed(key);
    return own != nullptr ? own->is_of(method) : has_key(method, key);
}

const Keys& own_keys()
{
    static const Keys own = std::make_shared<const KeyTable>();
    return own;
}

const KeyTable& keys_of(const Job& job)
{
    return job.keys == nullptr ? *own_keys() : *job.keys;
}

std::optional<JobValue> default_of(const KeySpec& spec, const Job& job)
{
    Job defaults;
    defaults.method.name = job.method.name;
    defaults.shadow_map.layout = map_layout(job);
    return spec.get(defaults);
}

std::vector<std::pair<std::string, std::string>> resolved_keys(const Job& job)
{
    std::vector<std::pair<std::string, std::string>> resolved;
    for (const KeySpec& row : keys_of(job).rows()) {
        if (const auto value = row.get(job)) {
            resolved.emplace_back(row.key.name, to_toml(*value));
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

const JobValue* find_handed_value(const Job& job, std::string_view name)
{
    const HandedKey* key = keys_of(job).find_handed(name);
    return key == nullptr || !key->is_of(job.method.name) ? nullptr : &key->value_of(job);
}

bool is_engine_key(std::string_view name)
{
    constexpr std::string_view table = "engine";
    return name.starts_with(table) && (name.size() == table.size() || name[table.size()] == '.');
}

} // namespace gnomon::scene
