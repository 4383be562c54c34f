#pragma once

#include "scene/pixels/pixel_class.hpp"
#include "store/images/channel_file.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// The greatest size of an image, as for a job.
inline constexpr std::uint64_t most_image_pixels = 134'217'728;

/// Reads the channels of an EXR file: from `write_aov` (docs/aov.md), or another renderer's case
/// (docs/evaluate.md).
///
/// The file may be hostile: its header is checked before anything is decoded or allocated. Every
/// function throws scene::InputError also if the file is missing or not an EXR file of scanlines.
class LayerFile : public ChannelFile {
public:
    /// Reads only the header.
    /// @param advice  ends every message: how to get a valid file.
    LayerFile(const std::filesystem::path& path, std::string advice);

    [[nodiscard]] scene::ImageSize size() const override { return size_; }
    [[nodiscard]] LayerType type(const std::string& name) override;
    [[nodiscard]] std::vector<std::string> names() override;
    [[nodiscard]] std::uint64_t decoded_bytes() override;
    [[nodiscard]] scene::Image<float> floats(const std::string& name) override;
    [[nodiscard]] scene::Image<std::uint32_t> integers(const std::string& name) override;
    [[nodiscard]] scene::Image<float> numbers(const std::string& name) override;
    /// The channel `class`. @throws scene::InputError  also for a code above 6.
    [[nodiscard]] scene::Image<scene::PixelClass> classes(const std::string& name = "class");
    /// "zip", "dwaa", …; empty: unknown.
    [[nodiscard]] std::string compression();
    /// Whether the display window equals the data window.
    [[nodiscard]] bool is_whole_display();
    /// The header's texts by name, without the prefix "gnomon:": "eye", "job", ….
    [[nodiscard]] std::map<std::string, std::string> texts();

private:
    [[nodiscard]] const ExrHeader& header();
    /// Null if the file has no such channel.
    [[nodiscard]] const ExrHeader::Channel* find(const std::string& name);
    template <typename Value>
    [[nodiscard]] scene::Image<Value> channel(const std::string& name, LayerType type);

    [[noreturn]] void refuse(std::string_view what) const;

    std::filesystem::path path_;
    std::string advice_;
    scene::ImageSize size_;
    std::unique_ptr<ExrInput> input_; ///< opened after the size was checked
    /// All channels. They are compressed together, so reading one by one would decompress all each
    /// time.
    std::vector<std::byte> pixels_;
};

} // namespace gnomon::store
