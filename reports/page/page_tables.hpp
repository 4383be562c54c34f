#pragma once

#include "reports/page/packed_blocks.hpp"
#include "store/run/run_reader.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::reports {

/// A run's configurations as a page has them (docs/report.md#data).
struct PageTable {
    store::Json columns; ///< {"count", "columns"}: those in which rows differ
    store::Json constants = store::Json::object(); ///< the others that have a value, as texts
};

/// Beyond so many rows a table leaves out their ids, which hardly compress.
inline constexpr std::size_t most_rows_with_ids = 20'000;

[[nodiscard]] PageTable read_table(const store::RunReader& run, PackedBlocks& blocks);

/// Ids of the finished curves, in the order of the sweep.
[[nodiscard]] std::vector<std::string> curve_ids(const store::RunReader& run);

/// The bias curves with their exact counts. Beyond 400,000 points each curve is thinned to every
/// n-th and its last; counts stay exact at each.
[[nodiscard]] store::Json read_curves(const store::RunReader& run,
                                      const std::vector<std::string>& curves, PackedBlocks& blocks);

/// Errors by light distance, of as many of the curves as 60,000 rows hold.
[[nodiscard]] store::Json read_error_vs_z(const store::RunReader& run,
                                          const std::vector<std::string>& curves,
                                          PackedBlocks& blocks);

} // namespace gnomon::reports
