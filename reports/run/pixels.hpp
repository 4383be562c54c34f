#pragma once

#include <filesystem>
#include <string_view>

namespace gnomon::reports {

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

} // namespace gnomon::reports
