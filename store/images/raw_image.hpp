#pragma once

#include "store/images/channel_file.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::store {

/// The layout of the numbers in a raw file.
struct RawLayout {
    scene::ImageSize size;
    int channel_count = 0; ///< interleaved numbers per pixel
    std::size_t offset_bytes = 0;
    bool is_bottom_up = false; ///< the format puts the lowest row first
};

/// A file of raw 32-bit floats: NumPy's .npy, with shape (height, width) or (height, width, n), or
/// a portable float map, .pfm.
///
/// The file may be hostile: its header is checked against the file's size before memory is
/// allocated. Source: numpy.lib.format, versions 1.0 to 3.0; Debevec's PFM (PF, Pf), with the
/// lowest row first.
class RawImage : public ChannelFile {
public:
    /// Reads only the header.
    /// @param names   of the channels, in order; the file may have fewer.
    /// @param least   smallest number of channels.
    /// @param advice  ends every message: how to get a valid file.
    RawImage(const std::filesystem::path& path, std::vector<std::string> names, std::size_t least,
             std::string advice);

    [[nodiscard]] scene::ImageSize size() const override { return layout_.size; }
    [[nodiscard]] std::vector<std::string> names() override { return names_; }
    [[nodiscard]] LayerType type(const std::string& name) override;
    [[nodiscard]] std::uint64_t decoded_bytes() override;
    [[nodiscard]] scene::Image<float> floats(const std::string& name) override;
    /// Whether the format fixes the order of rows.
    [[nodiscard]] bool has_own_order() const { return layout_.is_bottom_up; }
    /// Throws, because raw files hold only floats.
    [[nodiscard]] scene::Image<std::uint32_t> integers(const std::string& name) override;
    [[nodiscard]] scene::Image<float> numbers(const std::string& name) override
    {
        return floats(name);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const;

    std::filesystem::path path_;
    std::vector<std::string> names_;
    std::string advice_;
    RawLayout layout_;
    std::vector<float> pixels_; ///< all channels, read on first use
};

/// Whether the name ends in .npy or .pfm, in upper or lower case.
[[nodiscard]] bool is_raw_image(const std::filesystem::path& path);

} // namespace gnomon::store
