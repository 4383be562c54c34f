#pragma once

#include "scene/job/file.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::methods {

/// Where a bias term acts.
enum class BiasPlace : std::uint8_t {
    map_drawn,       ///< the depths that are drawn into the map
    receiver_depth,  ///< the receiver's depth, before it is compared
    lookup_position, ///< the point that is looked up
    per_tap,         ///< the depth that each tap is compared with
};

/// A part of what keeps a surface from shadowing itself.
struct BiasTerm {
    std::string_view name;
    std::span<const std::string_view> keys; ///< of a job, that set it: one, or one in place of
                                            ///< another; their rows have units and stages
    BiasPlace place = BiasPlace::receiver_depth;
    std::string_view sentence; ///< with its formula
};

/// The rows of its keys in the key table.
/// @throws std::invalid_argument  if a key has no row.
[[nodiscard]] std::vector<scene::JobKey> keys_of(const BiasTerm& term);

/// The stages of a sweep that must be redone when it changes: those of its keys.
/// @throws std::invalid_argument  if a key has no row.
[[nodiscard]] scene::Stages stages_of(const BiasTerm& term);

/// The place as results and documents spell it: "receiver_depth".
[[nodiscard]] std::string_view name(BiasPlace place);

} // namespace gnomon::methods
