#pragma once

#include "analysis/gate/gate_rules.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// Reads the rules of a gate (docs/gate.md).
/// @return  At least one; each rule's place is the file and line of its `[[rule]]`.
/// @throws scene::InputError  "file:line: key: …", if a key is unknown or missing, or a value is
///                            not allowed; also if the file cannot be read or is not TOML.
[[nodiscard]] std::vector<analysis::GateRule> read_gate_rules(const std::filesystem::path& file);

/// @param name  The file name for messages.
[[nodiscard]] std::vector<analysis::GateRule> parse_gate_rules(std::string_view text,
                                                               const std::string& name);

} // namespace gnomon::reports
