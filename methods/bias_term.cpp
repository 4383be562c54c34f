#include "methods/bias_term.hpp"

#include "scene/job/keys.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace gnomon::methods {

std::vector<scene::JobKey> keys_of(const BiasTerm& term)
{
    std::vector<scene::JobKey> keys;
    for (const std::string_view key : term.keys) {
        const scene::KeySpec* spec = scene::find_key(key);
        if (spec == nullptr) {
            throw std::invalid_argument(fmt::format("keys_of: {} has no key {}", term.name, key));
        }
        keys.push_back(spec->key);
    }
    return keys;
}

scene::Stages stages_of(const BiasTerm& term)
{
    scene::Stages stages = 0;
    for (const scene::JobKey& key : keys_of(term)) {
        stages = static_cast<scene::Stages>(stages | key.stages);
    }
    return stages;
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
