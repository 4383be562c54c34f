#include "methods/bias_term.hpp"

#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace gnomon::methods {
namespace {

using scene::Stage;

[[noreturn]] void refuse(const BiasTerm& term, std::string_view why)
{
    throw std::invalid_argument(fmt::format("bias term {}: {}", term.name, why));
}

/// Checks that the term's own keys are in `[bias]` and among its keys.
void check_own_keys(const BiasTerm& term)
{
    if (term.own_keys == nullptr) {
        return;
    }
    for (const scene::Key& own : term.own_keys()) {
        if (!own.name.starts_with("bias.")) {
            refuse(term, "its keys must be of [bias]");
        }
        if (std::ranges::find(term.keys, own.name) == term.keys.end()) {
            refuse(term, fmt::format("its keys lack {}", own.name));
        }
    }
}

} // namespace

std::vector<scene::Key> keys_of(const BiasTerm& term)
{
    const auto own = term.own_keys == nullptr ? std::vector<scene::Key>{} : term.own_keys();
    std::vector<scene::Key> keys;
    for (const std::string_view key : term.keys) {
        if (const scene::Key* shared = scene::own_keys()->find(key)) {
            keys.push_back(*shared);
            continue;
        }
        const auto row = std::ranges::find(own, key, &scene::Key::name);
        if (row == own.end()) {
            throw std::invalid_argument(fmt::format("keys_of: {} has no key {}", term.name, key));
        }
        keys.push_back(*row);
    }
    return keys;
}

scene::Stages stages_of(const BiasTerm& term)
{
    scene::Stages stages = 0;
    for (const scene::Key& key : keys_of(term)) {
        stages = static_cast<scene::Stages>(stages | key.stages);
    }
    return stages;
}

bool is_of_curve(const BiasTerm& term)
{
    return stages_of(term) == scene::only(Stage::bias);
}

void check(const BiasTerm& term)
{
    check_own_keys(term);
    const scene::Stages stages = stages_of(term);
    switch (term.place) {
    case BiasPlace::map_drawn:
        if (stages != scene::only(Stage::shadow_map)) {
            refuse(term, "the stage of its keys must be shadow map");
        }
        if (term.offset == nullptr) {
            refuse(term, "it has no offset");
        }
        return;
    case BiasPlace::receiver_depth:
        if (stages == scene::only(Stage::bias)) {
            if (term.own_keys != nullptr) {
                refuse(term, "the bias curve's formula has constant and slope alone: its stage "
                             "must be lookup");
            }
            break;
        }
        [[fallthrough]];
    case BiasPlace::lookup_position:
    case BiasPlace::per_tap:
        if (stages != scene::only(Stage::lookup)) {
            refuse(term, "the stage of its keys must be lookup");
        }
        break;
    }
    if (term.function.empty() || term.snippet == nullptr) {
        refuse(term, "it has no GLSL");
    }
}

void check(std::span<const BiasTerm> terms)
{
    std::ranges::for_each(terms, [](const BiasTerm& term) { check(term); });
    const auto varied = std::ranges::find_if(terms, is_of_curve);
    if (varied != terms.end() &&
        std::ranges::find(varied->keys, "bias.constant") == varied->keys.end()) {
        refuse(*varied, "the bias curve varies the first of its terms, which must be the constant "
                        "bias");
    }
}

double number_in(const scene::Job& job, std::string_view key)
{
    const scene::JobValue* value = scene::find_added_value(job, key);
    if (value == nullptr) {
        return 0;
    }
    const auto* number = std::get_if<double>(value);
    if (number == nullptr) {
        throw std::invalid_argument(fmt::format("number_in: {} is no number", key));
    }
    return *number;
}

std::vector<ActiveBias> active_biases(std::span<const BiasTerm> terms, const scene::Job& job,
                                      const scene::View& view)
{
    std::vector<ActiveBias> active;
    for (const BiasTerm& term : terms) {
        if (term.snippet == nullptr) {
            continue; // acts on the map
        }
        if (auto snippet = term.snippet(job, view)) {
            active.push_back({&term, *std::move(snippet)});
        }
    }
    return active;
}

bool moves_lookups(std::span<const ActiveBias> biases)
{
    return !std::ranges::all_of(biases,
                                [](const ActiveBias& bias) { return is_of_curve(*bias.term); });
}

std::string_view name(BiasPlace place)
{
    switch (place) {
    case BiasPlace::map_drawn:
        return "map_drawn";
    case BiasPlace::receiver_depth:
        return "receiver_depth";
    case BiasPlace::lookup_position:
        return "lookup_position";
    case BiasPlace::per_tap:
        return "per_tap";
    }
    return {};
}

} // namespace gnomon::methods
