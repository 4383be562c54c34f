#include "scene/job/handed_key.hpp"

#include "scene/job/engine_keys.hpp"
#include "scene/job/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace gnomon::scene {
namespace {

struct HandedMethods {
    std::vector<HandedMethod> methods{{Job{}.method.name, true}};
    std::vector<HandedKey> keys;
    bool is_read = false;
};

HandedMethods& handed()
{
    static HandedMethods all;
    return all;
}

/// Of those, the one of a job that names none.
const std::string& default_of(const std::vector<HandedMethod>& methods)
{
    const auto depth = std::ranges::find(methods, Job{}.method.name, &HandedMethod::name);
    return depth == methods.end() ? methods.front().name : depth->name;
}

KeySpec name_key(const std::vector<HandedMethod>& methods)
{
    WordDomain names;
    for (const HandedMethod& method : methods) {
        names.words.push_back(method.name);
    }
    return member_key<std::string>(
        make_key("method.name", "what decides verdicts; `gnomon methods` lists them",
                 to_toml(JobValue{default_of(methods)}), Stage::prefilter | Stage::lookup),
        std::move(names), [](auto& job) -> auto& { return job.method.name; });
}

/// nullptr: there is none of that name.
const HandedMethod* find_method(std::string_view name)
{
    const auto& methods = handed().methods;
    const auto found = std::ranges::find(methods, name, &HandedMethod::name);
    return found == methods.end() ? nullptr : &*found;
}

bool is_of_table(const HandedKey& key, std::string_view table)
{
    const std::string_view name = key.key.name;
    return name.substr(0, name.rfind('.')) == table;
}

KeySpec spec_of(const HandedKey& handed_key)
{
    return {.key = handed_key.row(),
            .domain = handed_key.domain,
            .set = [name = handed_key.key.name](
                       Job& job, const JobValue& value) { job.method.values[name] = value; },
            .get = [handed_key](const Job& job) -> std::optional<JobValue> {
                // A bias that a job does not name is none: jobs say nothing of those.
                const bool is_left_out = is_of_table(handed_key, "bias") &&
                                         !job.method.values.contains(handed_key.key.name);
                return handed_key.is_of(job.method.name) && !is_left_out
                           ? std::optional{handed_key.value_of(job)}
                           : std::nullopt;
            },
            .example = {}};
}

} // namespace

bool HandedKey::is_of(std::string_view method) const
{
    return is_of_table(*this, "engine") || std::ranges::find(methods, method) != methods.end();
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

void hand_over_methods(std::vector<HandedMethod> methods, std::vector<HandedKey> keys)
{
    if (handed().is_read) {
        throw std::logic_error("hand_over_methods: the table of keys was read already");
    }
    if (methods.empty()) {
        throw std::logic_error("hand_over_methods: there is no method");
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!is_of_table(keys[i], "method") && !is_of_table(keys[i], "bias")) {
            throw std::logic_error(
                fmt::format("hand_over_methods: {} is neither of [method] nor of "
                            "[bias]",
                            keys[i].key.name));
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (keys[i].key.name == keys[j].key.name) {
                throw std::logic_error(
                    fmt::format("hand_over_methods: {} repeats", keys[i].key.name));
            }
        }
    }
    handed().methods = std::move(methods);
    handed().keys = std::move(keys);
}

void hand_over_engine(std::vector<HandedKey> keys)
{
    std::vector<KeySpec> specs;
    for (HandedKey& key : keys) {
        if (!is_of_table(key, "engine") || find_handed_key(key.key.name) != nullptr) {
            throw std::logic_error(
                fmt::format("hand_over_engine: {} is not of [engine], or repeats", key.key.name));
        }
        specs.push_back(spec_of(key));
        handed().keys.push_back(std::move(key));
    }
    add_key_specs(std::move(specs));
}

bool is_engine_key(std::string_view name)
{
    constexpr std::string_view table = "engine";
    return name.starts_with(table) && (name.size() == table.size() || name[table.size()] == '.');
}

const std::vector<HandedKey>& handed_keys()
{
    return handed().keys;
}

KeySpec method_name_key()
{
    return name_key(handed().methods);
}

std::vector<KeySpec> handed_key_specs(std::string_view table)
{
    HandedMethods& all = handed();
    all.is_read = true;
    std::vector<KeySpec> specs;
    for (const HandedKey& key : all.keys) {
        if (is_of_table(key, table)) {
            specs.push_back(spec_of(key));
        }
    }
    return specs;
}

const std::string& default_method()
{
    return default_of(handed().methods);
}

bool has_filters(std::string_view method)
{
    const HandedMethod* found = find_method(method);
    return found != nullptr && found->has_filters;
}

bool has_key(std::string_view method, std::string_view key)
{
    if (key == "lookup.filter") {
        return has_filters(method);
    }
    const HandedMethod* found = find_method(method);
    return found == nullptr ||
           std::ranges::find(found->unread_tables, key.substr(0, key.find('.'))) ==
               found->unread_tables.end();
}

bool has_any_key(std::string_view method, std::string_view key)
{
    const HandedKey* handed_key = find_handed_key(key);
    return handed_key != nullptr ? handed_key->is_of(method) : has_key(method, key);
}

const HandedKey* find_handed_key(std::string_view name)
{
    const auto& keys = handed().keys;
    const auto found =
        std::ranges::find(keys, name, [](const HandedKey& key) { return key.key.name; });
    return found == keys.end() ? nullptr : &*found;
}

} // namespace gnomon::scene
