#pragma once

#include "cli/renderer/protocol/renderer_answers.hpp"
#include "cli/renderer/protocol/renderer_requests.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace gnomon::cli {

/// The amount of error [px] with these values of the engine's keys; empty: it cannot be drawn.
using MeasureEngine = std::function<std::optional<double>(const EngineValues&)>;

/// What a search found.
struct EngineSearchResult {
    EngineValues best;
    double amount = 0;         ///< of `best` [px]
    std::size_t measured = 0;  ///< how many settings
    bool is_exhausted = false; ///< the budget ended the search, not the lack of better settings
};

/// Searches the values of keys with the smallest amount of error, key by key and again until
/// nothing gets better. Of choices every value is tried. Of numbers those at the distances ±(most −
/// least)·10^−k, k = 0 … 7, from where the key started, then half and twice the best distance and
/// what lies between, as thresholds and biases have scales rather than steps.
///
/// Of equal amounts what was measured first counts: a key that changes nothing stays.
/// @param keys    that are searched; others stay as they are.
/// @param start   of all keys.
/// @param budget  so many settings are measured at most; at least 1.
/// @param measure  is asked once for each setting.
/// @throws std::invalid_argument  if the start cannot be drawn.
[[nodiscard]] EngineSearchResult search_engine(const std::vector<EngineKey>& keys,
                                               const EngineValues& start, std::size_t budget,
                                               const MeasureEngine& measure);

} // namespace gnomon::cli
