#include "scene/job/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

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

/// The method of that name, or nullptr.
const HandedMethod* find_method(std::string_view name)
{
    const auto& methods = handed().methods;
    const auto found = std::ranges::find(methods, name, &HandedMethod::name);
    return found == methods.end() ? nullptr : &*found;
}

KeySpec spec_of(const HandedKey& handed_key)
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
            .example = {}};
}

std::vector<KeySpec> handed_key_specs(std::string_view table)
{
    HandedMethods& all = handed();
    all.is_read = true;
    std::vector<KeySpec> specs;
    for (const HandedKey& key : all.keys) {
        if (key.table() == table) {
            specs.push_back(spec_of(key));
        }
    }
    return specs;
}

/// What follows from the rest of a row.
void finish_row(KeySpec& spec)
{
    spec.key.range_text = range_text(spec.domain);
    spec.get = [name = spec.key.name, get = std::move(spec.get)](const Job& job) {
        return has_key(job.method.name, name) ? get(job) : std::nullopt;
    };
}

std::vector<KeySpec> all_key_specs()
{
    std::vector<KeySpec> specs;
    for (const auto& group :
         {look_key_specs(), std::vector{name_key(handed().methods)}, handed_key_specs("method"),
          map_key_specs(), handed_key_specs("bias")}) {
        specs.insert(specs.end(), group.begin(), group.end());
    }
    std::ranges::for_each(specs, finish_row);
    return specs;
}

/// A table that may still grow.
std::vector<KeySpec>& key_table()
{
    static std::vector<KeySpec> specs = all_key_specs();
    return specs;
}

std::vector<JobKey> rows_of(const std::vector<KeySpec>& specs)
{
    std::vector<JobKey> all;
    for (const KeySpec& spec : specs) {
        all.push_back(spec.key);
    }
    return all;
}

std::vector<JobKey>& key_rows()
{
    static std::vector<JobKey> keys = rows_of(key_specs());
    return keys;
}

void add_key_specs(std::vector<KeySpec> specs)
{
    std::ranges::for_each(specs, finish_row);
    key_table().insert(key_table().end(), specs.begin(), specs.end());
    key_rows() = rows_of(key_table());
}

} // namespace

const std::vector<KeySpec>& key_specs()
{
    return key_table();
}

const KeySpec* find_key(std::string_view name)
{
    const auto& specs = key_specs();
    const auto found = std::find_if(specs.begin(), specs.end(),
                                    [&](const KeySpec& spec) { return spec.key.name == name; });
    return found == specs.end() ? nullptr : &*found;
}

std::optional<JobValue> default_of(const KeySpec& spec, const Job& job)
{
    Job defaults;
    defaults.method.name = job.method.name;
    defaults.shadow_map.layout = map_layout(job);
    return spec.get(defaults);
}

bool is_key_table(std::string_view name)
{
    const auto& specs = key_specs();
    const std::string prefix = std::string{name} + ".";
    return std::any_of(specs.begin(), specs.end(), [&](const KeySpec& spec) {
        return std::string_view{spec.key.name}.starts_with(prefix);
    });
}

const std::vector<JobKey>& job_keys()
{
    return key_rows();
}

std::vector<std::pair<std::string, std::string>> resolved_keys(const Job& job)
{
    std::vector<std::pair<std::string, std::string>> resolved;
    for (const KeySpec& spec : key_specs()) {
        if (const auto value = spec.get(job)) {
            resolved.emplace_back(spec.key.name, to_toml(*value));
        }
    }
    return resolved;
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
        if (keys[i].table() != "method" && keys[i].table() != "bias") {
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
        if (key.table() != "engine" || find_handed_key(key.key.name) != nullptr) {
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
