#pragma once

#include "analysis/comparison/comparison.hpp"

#include <filesystem>
#include <string_view>

namespace gnomon::api {

/// Writes every layer of a configuration to RUN/pixels/ID.exr (docs/aov.md), and what
/// `gnomon compare --json` prints for it to RUN/pixels/ID.json.
/// @throws scene::EnvironmentError  if it cannot be written.
void keep_pixels(const std::filesystem::path& folder, std::string_view id,
                 const analysis::Comparison& comparison);

} // namespace gnomon::api
