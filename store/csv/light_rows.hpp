#pragma once

#include "store/run/result_row.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::store {

/// The row of all lights together, beside those of each: counts and amounts are sums, rates those
/// of the sums; what all lights have in common is as it is, and what belongs to one, or is no sum,
/// is empty. The light is empty. It is `done` when all of them are.
/// @param lights       rows of `results` of the lights of one configuration; at least one.
/// @param light_count  of the configuration: other parts of the run may have more of them.
[[nodiscard]] std::vector<sqlite::Value> total_row(std::span<const ResultRow> lights,
                                                   std::size_t light_count);

} // namespace gnomon::store
