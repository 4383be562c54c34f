#pragma once

#include "store/images/channel_file.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::store {

/// Where a raw file's numbers begin, and how they lie.
struct RawLayout {
    scene::ImageSize size;
    int channel_count = 0; ///< numbers of a pixel, side by side
    std::size_t offset_bytes = 0;
    bool is_bottom_up = false; ///< the format says that the lowest row comes first
};

/// A file of raw 32-bit floats: NumPy's .npy, of the shape (height, width) or (height, width, n),
/// or a portable float map, .pfm.
///
/// The file may be hostile: its header is held to the file's size before memory is taken. Formats:
/// numpy.lib.format, versions 1.0 to 3.0; Debevec's PFM (PF, Pf), whose rows begin with the lowest.
class RawImage : public ChannelFile {
public:
    /// Reads no more than the header.
    /// @param names   What its channels are to be called, in their order; the file may have fewer.
    /// @param least   It must have so many.
    /// @param advice  ends every message: how to get a sound file.
    RawImage(const std::filesystem::path& path, std::vector<std::string> names, std::size_t least,
             std::string advice);

    [[nodiscard]] scene::ImageSize size() const override { return layout_.size; }
    [[nodiscard]] std::vector<std::string> names() override { return names_; }
    [[nodiscard]] LayerType type(const std::string& name) override;
    [[nodiscard]] std::uint64_t decoded_bytes() override;
    [[nodiscard]] scene::Image<float> floats(const std::string& name) override;
    /// Whether the format says which row comes first.
    [[nodiscard]] bool has_own_order() const { return layout_.is_bottom_up; }
    /// Throws: it has floats alone.
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
    std::vector<float> pixels_; ///< all of them, once one is asked for
};

/// Whether the name ends as a raw file's does: .npy or .pfm, in letters of either case.
[[nodiscard]] bool is_raw_image(const std::filesystem::path& path);

} // namespace gnomon::store
