#pragma once

#include "scene/job/setting_layers.hpp"
#include "scene/job/toml.hpp"

#include <string>
#include <vector>

namespace gnomon::scene {

/// The `[[case]]` tables of a job file.
/// @throws InputError  if one has no name, two have the same, or a key does not accept its value.
[[nodiscard]] std::vector<CaseLayer> read_cases(const KeyTable& keys, const TomlMember& member,
                                                const std::string& file);

} // namespace gnomon::scene
