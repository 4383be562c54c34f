#include "methods/job_method.hpp"

#include "methods/list.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gnomon::methods {

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

LookupTraits traits(const scene::Job& job)
{
    const LookupTraits promised = method_of(job).traits(job);
    return scene::mixes_maps(job) ? mixed(promised) : promised;
}

void check(const scene::Job& job)
{
    const Method& method = method_of(job);
    const LookupTraits promised = method.traits(job);
    for (const BiasTerm& term : method.bias_terms) {
        if (term.check != nullptr) {
            term.check(job, promised);
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

} // namespace gnomon::methods
