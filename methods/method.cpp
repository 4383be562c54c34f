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

/// Of the tables that methods share, those whose keys it has none of.
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

/// The method's own keys, and those of its bias terms.
std::vector<scene::HandedKey> own_keys(const Method& method)
{
    std::vector<scene::HandedKey> keys = method.keys;
    for (const BiasTerm& term : method.bias_terms) {
        if (term.own_keys != nullptr) {
            std::ranges::copy(term.own_keys(), std::back_inserter(keys));
        }
    }
    return keys;
}

bool is_same_row(const scene::HandedKey& a, const scene::HandedKey& b)
{
    const scene::JobKey row_a = a.row();
    const scene::JobKey row_b = b.row();
    return row_a.description == row_b.description && row_a.unit == row_b.unit &&
           row_a.range_text == row_b.range_text && row_a.default_text == row_b.default_text &&
           row_a.stages == row_b.stages && a.tried.values == b.tried.values &&
           a.tried.unit == b.tried.unit;
}

/// The keys of all methods, each once, with the names of all methods that have it.
std::vector<scene::HandedKey> all_keys()
{
    std::vector<scene::HandedKey> all;
    for (const Method& method : methods()) {
        for (const scene::HandedKey& key : own_keys(method)) {
            const auto same = std::ranges::find(
                all, key.key.name, [](const scene::HandedKey& known) { return known.key.name; });
            if (same != all.end() && !is_same_row(*same, key)) {
                throw std::invalid_argument(
                    fmt::format("methods: {} of {} is another key than that of another method",
                                key.key.name, method.name));
            }
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
        // Handed to the table are also keys of other methods' bias terms.
        return is_read && (key.name != "lookup.filter" || !method.filters.empty()) &&
               scene::find_handed_key(key.name) == nullptr;
    });
    for (const scene::HandedKey& own : own_keys(method)) {
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
    const Promises promised = method_of(job).promises(job);
    return scene::mixes_maps(job) ? mixed(promised) : promised;
}

void check(const scene::Job& job)
{
    const Method& method = method_of(job);
    for (const BiasTerm& term : method.bias_terms) {
        if (term.check != nullptr) {
            term.check(job);
        }
    }
    if (method.check != nullptr) {
        method.check(job);
    }
}

Passes passes(const scene::Job& job)
{
    return method_of(job).passes(job);
}

std::vector<ActiveBias> active_biases(const scene::Job& job, const scene::View& view)
{
    return active_biases(method_of(job).bias_terms, job, view);
}

bool moves_lookups(const scene::Job& job, const scene::View& view)
{
    return map_offset(job, view) || moves_lookups(active_biases(job, view));
}

std::optional<PolygonOffset> map_offset(const scene::Job& job, const scene::View& view)
{
    for (const BiasTerm& term : method_of(job).bias_terms) {
        if (term.offset != nullptr) {
            if (const auto offset = term.offset(view)) {
                return offset;
            }
        }
    }
    return std::nullopt;
}

std::optional<double> normal_offset_m(const scene::Job& job, const scene::View& view,
                                      std::size_t map, double light_distance_m)
{
    double length_m = 0;
    for (const ActiveBias& bias : active_biases(job, view)) {
        if (bias.term->place != BiasPlace::lookup_position) {
            continue;
        }
        if (bias.term->length_m == nullptr) {
            return std::nullopt;
        }
        length_m += bias.term->length_m(job, view, map, light_distance_m);
    }
    return length_m;
}

scene::VertexNormals vertex_normals(const scene::Job& job)
{
    const bool are_read = std::ranges::any_of(method_of(job).bias_terms, [&](const BiasTerm& term) {
        return term.reads_vertex_normals != nullptr && term.reads_vertex_normals(job);
    });
    return are_read ? scene::VertexNormals::kept : scene::VertexNormals::dropped;
}

scene::VertexNormals vertex_normals(std::span<const scene::LightJob> jobs)
{
    const bool are_read = std::ranges::any_of(jobs, [](const scene::LightJob& light) {
        return vertex_normals(light.job) == scene::VertexNormals::kept;
    });
    return are_read ? scene::VertexNormals::kept : scene::VertexNormals::dropped;
}

std::vector<std::string_view> moving_bias_keys(const scene::Job& job)
{
    std::vector<std::string_view> keys;
    for (const BiasTerm& term : method_of(job).bias_terms) {
        if (!is_of_curve(term)) {
            keys.insert(keys.end(), term.keys.begin(), term.keys.end());
        }
    }
    return keys;
}

void hand_keys_to_scene()
{
    std::vector<scene::HandedMethod> all;
    for (const Method& method : methods()) {
        all.push_back({std::string{method.name}, !method.filters.empty(), unread_tables(method)});
    }
    scene::hand_over_methods(std::move(all), all_keys());
    for (const Method& method : methods()) {
        check(method.bias_terms);
    }
}

} // namespace gnomon::methods
