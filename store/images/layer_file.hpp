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

/// As of a job's image.
inline constexpr std::uint64_t most_image_pixels = 134'217'728;

/// An EXR file whose channels are read by their names: of `write_aov` (docs/aov.md), or of another
/// renderer's case (docs/evaluate.md).
///
/// The file may be hostile: its header is checked before anything is decoded or memory taken.
/// Every function throws scene::InputError also if the file is missing or no EXR file of scanlines.
class LayerFile : public ChannelFile {
public:
    /// Reads no more than the header.
    /// @param advice  ends every message: how to get a sound file.
    LayerFile(const std::filesystem::path& path, std::string advice);

    [[nodiscard]] scene::ImageSize size() const override { return size_; }
    [[nodiscard]] LayerType type(const std::string& name) override;
    [[nodiscard]] std::vector<std::string> names() override;
    [[nodiscard]] std::uint64_t decoded_bytes() override;
    [[nodiscard]] scene::Image<float> floats(const std::string& name) override;
    [[nodiscard]] scene::Image<std::uint32_t> integers(const std::string& name) override;
    [[nodiscard]] scene::Image<float> numbers(const std::string& name) override;
    /// The channel `class`. @throws scene::InputError  also for a code beyond 6.
    [[nodiscard]] scene::Image<scene::PixelClass> classes(const std::string& name = "class");
    /// "zip", "dwaa", …; empty: one that nobody knows.
    [[nodiscard]] std::string compression();
    /// False where the display window is another than the data window.
    [[nodiscard]] bool is_whole_display();
    /// The header's texts that begin with "gnomon:", by their names without it: "eye", "job", ….
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
    std::unique_ptr<ExrInput> input_; ///< once the file's size is known to be right
    /// All channels as the file has them: they are compressed together, so that reading one by one
    /// would decompress each of them every time.
    std::vector<std::byte> pixels_;
};

} // namespace gnomon::store
