#pragma once

#include "scene/image.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::testing {

/// The channels of one image, interleaved in a raw file.
using RawChannels = std::vector<const scene::Image<float>*>;

inline std::string raw_pixels(const RawChannels& channels, bool is_bottom_up)
{
    const auto [width, height] = channels.front()->size();
    std::string bytes;
    for (int row = 0; row < height; ++row) {
        for (int x = 0; x < width; ++x) {
            for (const scene::Image<float>* const channel : channels) {
                const float value = (*channel)(x, is_bottom_up ? height - 1 - row : row);
                bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
            }
        }
    }
    return bytes;
}

/// The header as numpy.save of version 1.0 writes it.
inline std::string npy_header(std::string_view type, std::string_view order,
                              const std::string& shape)
{
    std::string text =
        fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}", type, order, shape);
    text.append(63 - (text.size() + 10) % 64, ' ');
    text += '\n';
    std::string header{"\x93NUMPY\x01\x00", 8};
    header += static_cast<char>(text.size() % 256);
    header += static_cast<char>(text.size() / 256);
    return header + text;
}

inline void write_npy(const std::filesystem::path& file, const RawChannels& channels,
                      bool is_bottom_up = false)
{
    const auto [width, height] = channels.front()->size();
    const std::string shape = channels.size() == 1
                                  ? fmt::format("({}, {})", height, width)
                                  : fmt::format("({}, {}, {})", height, width, channels.size());
    std::ofstream{file, std::ios::binary} << npy_header("<f4", "False", shape)
                                          << raw_pixels(channels, is_bottom_up);
}

/// @param channels  one or three.
inline void write_pfm(const std::filesystem::path& file, const RawChannels& channels)
{
    const auto [width, height] = channels.front()->size();
    std::ofstream{file, std::ios::binary}
        << fmt::format("{}\n{} {}\n-1.0\n", channels.size() == 3 ? "PF" : "Pf", width, height)
        << raw_pixels(channels, true);
}

} // namespace gnomon::testing
