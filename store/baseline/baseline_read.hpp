#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "scene/error.hpp"

#include <filesystem>
#include <string>

namespace gnomon::store {

/// Reads what `baseline_json` writes, and nothing else: files come from anywhere.
/// @throws BaselineMissing    if there is no such file.
/// @throws scene::InputError  naming the file and the place in it, if the text is cut short, nests
///                            too deeply, repeats, lacks or adds a key, or if a value has another
///                            type, or is not what it can be.
[[nodiscard]] analysis::GateEntries read_baseline(const std::filesystem::path& file);

/// @param name  How messages speak of the text.
[[nodiscard]] analysis::GateEntries parse_baseline(const std::string& text,
                                                   const std::string& name);

} // namespace gnomon::store
