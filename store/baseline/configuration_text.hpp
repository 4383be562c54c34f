#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "store/json.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace gnomon::store {

/// "noon, bias.constant = 0.01"; "the only configuration" if there is neither case nor axis. One
/// line, whatever the names hold.
[[nodiscard]] std::string key_text(const analysis::ConfigurationKey& key);
/// {"case": "noon", "axes": {"bias.constant": "0.01"}}
[[nodiscard]] Json key_json(const analysis::ConfigurationKey& key);

/// A count as an integer, any other metric as a real number, null for none.
[[nodiscard]] Json metric_json(std::string_view metric, const std::optional<double>& value);

} // namespace gnomon::store
