#pragma once

#include "cli/renderer/protocol/renderer_answers.hpp"
#include "cli/renderer/protocol/renderer_requests.hpp"
#include "scene/light/light.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {

/// The measurement of one setting of the engine's keys.
struct EngineMeasure {
    std::optional<double> error = {}; ///< empty if it cannot be drawn, or does not count
    std::size_t frame = 0;            ///< equal for frames with equal pixels
    bool changes_view = false;        ///< it shows other surfaces, so its error cannot be compared
};
using MeasureEngine = std::function<EngineMeasure(const EngineValues&)>;

/// A key that the search left alone.
struct DroppedKey {
    std::string name;
    bool changes_view = false; ///< false: its ends change no pixel

    friend bool operator==(const DroppedKey&, const DroppedKey&) = default;
};

/// The result of a search.
struct EngineSearchResult {
    EngineValues best;
    double error = 0;          ///< of `best`
    std::size_t measured = 0;  ///< settings
    bool is_exhausted = false; ///< the budget ended the search
    std::vector<DroppedKey> dropped;
};

/// Searches for the values of keys with the smallest error: key by key, starting at the best known
/// setting, and again until nothing improves.
///
/// For each key it tries the ends of the range, or every value of a choice. It leaves a key alone
/// if that shows other surfaces, or changes no pixel. Numbers are then tried by powers of ten,
/// because biases have scales rather than steps: known·10^±k for k = 1 … 3, and 0; from a known 0,
/// ±(upper − lower)·10^−k for k = 1 … 7, on each side until a step changes no pixel. Last come
/// factors of 0.25 to 4 of the best value, then 0.7 to 1.4.
///
/// Among equal errors the first wins. The result is never worse than a known setting.
/// @param keys    the keys to search.
/// @param known   settings of all keys, such as an engine's documentation recommends; the first
///                must be drawable.
/// @param budget  the largest number of settings to measure; at least 1.
/// @param measure  called once for each setting.
/// @throws std::invalid_argument  if the first known setting cannot be drawn.
[[nodiscard]] EngineSearchResult search_engine(const std::vector<EngineKey>& keys,
                                               const std::vector<EngineValues>& known,
                                               std::size_t budget, const MeasureEngine& measure);

/// The values that an engine's documentation recommends for a type of light: the table
/// `[documented.engine]` of a league.toml, overridden by that of the light.
/// @param description  the file; if it is empty or missing, the result is empty.
/// @throws scene::InputError  naming the file and the key that is not valid.
/// Source: docs/league.md#entering-an-engine.
[[nodiscard]] EngineValues documented_values(const std::filesystem::path& description,
                                             scene::LightType light,
                                             const std::vector<EngineKey>& keys);

} // namespace gnomon::cli
