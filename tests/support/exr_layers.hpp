#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gnomon::store {

/// One part of an EXR file, read by OpenEXR without our code.
struct ExrLayers {
    std::string name; ///< empty if the file has one part
    int width_px = 0;
    int height_px = 0;
    /// 32 bits per pixel, row by row, by the channel's name.
    std::map<std::string, std::vector<std::uint32_t>> channels;
    std::map<std::string, bool> is_float; ///< by the channel's name
    std::map<std::string, std::string> texts;
    std::string compression; ///< "zip" or "another"

    [[nodiscard]] float value(const std::string& channel, std::size_t pixel) const;
};

/// @throws std::exception  if the file is damaged or has a channel of half floats.
[[nodiscard]] std::vector<ExrLayers> read_exr_parts(const std::filesystem::path& path);
/// The first part.
[[nodiscard]] ExrLayers read_exr(const std::filesystem::path& path);

} // namespace gnomon::store
