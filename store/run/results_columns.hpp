#pragma once

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
[[nodiscard]] std::vector<ResultsColumn> results_columns();
/// What they are selected from: `part` p, `configurations` c, the curve k that a configuration
/// belongs to, and the same v if the configuration is done.
[[nodiscard]] std::string results_tables();

} // namespace gnomon::store
