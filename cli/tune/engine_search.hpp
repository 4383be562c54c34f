#pragma once

#include "cli/renderer/protocol/renderer_answers.hpp"
#include "cli/renderer/protocol/renderer_requests.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {

/// What a setting of the engine's keys gives.
struct EngineMeasure {
    std::optional<double> error = {}; ///< to be small; empty: it cannot be drawn, or does not count
    std::size_t frame = 0;            ///< the same for frames that have the same pixels
    bool changes_view = false;        ///< it shows other surfaces: no frame to compare with others
};
using MeasureEngine = std::function<EngineMeasure(const EngineValues&)>;

/// A key that is not searched.
struct DroppedKey {
    std::string name;
    bool changes_view = false; ///< else its ends change no pixel

    friend bool operator==(const DroppedKey&, const DroppedKey&) = default;
};

/// What a search found.
struct EngineSearchResult {
    EngineValues best;
    double error = 0;          ///< of `best`
    std::size_t measured = 0;  ///< how many settings
    bool is_exhausted = false; ///< the budget ended the search, not the lack of better settings
    std::vector<DroppedKey> dropped;
};

/// Searches the values of keys with the smallest error, from the best of some known settings on:
/// key by key, and again until nothing gets better.
///
/// A key's ends come first, of choices every value. A key that changes what is seen is left as it
/// is; so is, until something else is better, one whose ends change no pixel. Numbers then go by
/// powers of ten: ×10^±k, k = 1 … 3, from a known value, and 0; from a known 0 ±(most −
/// least)·10^−k, k = 1 … 7, as biases have scales rather than steps, and on each side until a step
/// changes no pixel. Then come a quarter to four times the best value, and finer factors.
///
/// Of equal errors what was measured first counts. The result is never worse than a known setting.
/// @param keys    that are searched; others stay as they are.
/// @param known   settings of all keys, such as an engine's documentation recommends; the first
///                must be drawable.
/// @param budget  so many settings are measured at most; at least 1.
/// @param measure  is asked once for each setting.
/// @throws std::invalid_argument  if the first known setting cannot be drawn.
[[nodiscard]] EngineSearchResult search_engine(const std::vector<EngineKey>& keys,
                                               const std::vector<EngineValues>& known,
                                               std::size_t budget, const MeasureEngine& measure);

} // namespace gnomon::cli
