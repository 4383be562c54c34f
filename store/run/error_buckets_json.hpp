#pragma once

#include "analysis/metrics/error_buckets.hpp"
#include "store/json.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// "[4, 8)": the band's light distances [m].
[[nodiscard]] std::string band_text(analysis::LightDistanceBand band);
[[nodiscard]] std::optional<analysis::LightDistanceBand> band_from_text(std::string_view text);

/// Counts by object and band of light distance:
/// {"wall": {"[4, 8)": {"blocked": 7, "lit": 90, "false_shadow.resolution.edge": 3}}}.
[[nodiscard]] Json error_buckets_json(const std::vector<analysis::ErrorBucket>& buckets);

/// Reads the output of `error_buckets_json`.
/// @param place  of the JSON in its file, for messages.
/// @return  Sorted by object and band.
/// @throws scene::InputError  "place.key: …", if a key is unknown or a value is not a count.
[[nodiscard]] std::vector<analysis::ErrorBucket> error_buckets_from_json(const Json& json,
                                                                         const std::string& place);

} // namespace gnomon::store
