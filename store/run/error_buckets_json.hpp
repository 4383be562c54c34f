#pragma once

#include "analysis/metrics/error_buckets.hpp"
#include "store/json.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// "[4, 8)": the band's light distances in metres.
[[nodiscard]] std::string band_text(analysis::LightDistanceBand band);
[[nodiscard]] std::optional<analysis::LightDistanceBand> band_from_text(std::string_view text);

/// Objects, their bands, and the counts of each:
/// {"wall": {"[4, 8)": {"blocked": 7, "lit": 90, "false_shadow.resolution.edge": 3}}}.
[[nodiscard]] Json cells_json(const std::vector<analysis::ErrorBucket>& cells);

/// Reads what `cells_json` writes, and nothing else.
/// @param place  How messages name it.
/// @return  By object and band.
/// @throws scene::InputError  "place.key: …", if a key is unknown or a value is no count.
[[nodiscard]] std::vector<analysis::ErrorBucket> cells_from_json(const Json& json,
                                                                 const std::string& place);

} // namespace gnomon::store
