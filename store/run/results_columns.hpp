#pragma once

#include "store/sqlite.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::store {

/// A column of the view `results`, which is `results.csv`'s.
struct ResultsColumn {
    /// What its value is the same for.
    enum class Of : std::uint8_t {
        configuration,
        curve, ///< its configurations of the same status
    };

    std::string name;
    std::string expression; ///< over `results_tables()`
    Of of;
};
/// @param light_columns  of runs with several lights (`light_columns`).
[[nodiscard]] std::vector<ResultsColumn>
results_columns(const std::vector<std::string>& light_columns = {});
/// Those of a run's axes that are no keys of every job with one light, sorted: the light itself,
/// keys of one light alone, "lights.sun.bias.slope", and a renderer's own, "engine.bias".
[[nodiscard]] std::vector<std::string> light_columns(const std::vector<std::string>& axes);
/// The same of the run that the database holds, with all of its renderer's own keys.
[[nodiscard]] std::vector<std::string> light_columns(const sqlite::Database& database);
/// What they are selected from: `part` p, `configurations` c, the curve k that a configuration
/// belongs to, and the same v if the configuration is done.
[[nodiscard]] std::string results_tables();

} // namespace gnomon::store
