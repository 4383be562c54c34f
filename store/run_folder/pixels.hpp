#pragma once

#include "store/json.hpp"

#include <filesystem>
#include <string_view>

namespace gnomon::store {

/// Where a run keeps a configuration's layers (docs/aov.md): RUN/pixels/ID.exr.
[[nodiscard]] std::filesystem::path pixels_path(const std::filesystem::path& folder,
                                                std::string_view id);
/// Where it keeps what `gnomon compare --json` prints for it: RUN/pixels/ID.json.
[[nodiscard]] std::filesystem::path detail_path(const std::filesystem::path& folder,
                                                std::string_view id);

/// Makes RUN/pixels where there is none.
/// @throws scene::EnvironmentError  if it cannot be made.
void make_pixels_folder(const std::filesystem::path& folder);

/// Whether that is the name of a file in RUN/pixels: ID.exr or ID.json, with ID as in
/// `analysis::Configuration`.
[[nodiscard]] bool is_pixels_name(std::string_view name);

/// Takes over the kept layers of another run that this one lacks; links them where the file system
/// can.
/// @throws scene::EnvironmentError  if they cannot be written.
void take_pixels(const std::filesystem::path& folder, const std::filesystem::path& other);

/// Whether a run kept the layers of a configuration.
[[nodiscard]] bool has_image(const std::filesystem::path& folder, std::string_view id);

/// What `gnomon compare --json` printed for a configuration; null if its layers were not kept, or
/// the file is damaged.
[[nodiscard]] Json find_detail(const std::filesystem::path& folder, std::string_view id);

} // namespace gnomon::store
