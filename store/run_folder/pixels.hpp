#pragma once

#include "store/json.hpp"

#include <filesystem>
#include <string_view>

namespace gnomon::store {

/// The file of a configuration's kept layers (docs/aov.md): RUN/pixels/ID.exr.
[[nodiscard]] std::filesystem::path pixels_path(const std::filesystem::path& folder,
                                                std::string_view id);
/// The file of a configuration's `gnomon compare --json` output: RUN/pixels/ID.json.
[[nodiscard]] std::filesystem::path detail_path(const std::filesystem::path& folder,
                                                std::string_view id);

/// Creates RUN/pixels if it is missing.
/// @throws scene::EnvironmentError  if the folder cannot be created.
void make_pixels_folder(const std::filesystem::path& folder);

/// Whether a file in RUN/pixels may have this name: ID.exr or ID.json, with ID as in
/// `analysis::Configuration`.
[[nodiscard]] bool is_pixels_name(std::string_view name);

/// Takes over kept layers of another run that this one lacks, with hard links if the file system
/// can.
/// @throws scene::EnvironmentError  if a file cannot be written.
void take_pixels(const std::filesystem::path& folder, const std::filesystem::path& other);

/// Whether a run kept the layers of a configuration.
[[nodiscard]] bool has_image(const std::filesystem::path& folder, std::string_view id);

/// A configuration's `gnomon compare --json` output; null if its layers were not kept, or the file
/// is damaged.
[[nodiscard]] Json find_detail(const std::filesystem::path& folder, std::string_view id);

} // namespace gnomon::store
