#pragma once

#include "scene/image.hpp"
#include "scene/pixel_class.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace gnomon::reports {

/// An EXR file of `write_aov` (docs/aov.md), whose channels are read by their names.
///
/// The file may be hostile: its header is checked before anything is decoded or memory taken.
/// Every function throws scene::InputError, one line, if the file is missing, no EXR file of
/// scanlines, damaged or truncated, or if the channel is missing or of another type.
class LayerFile {
public:
    /// Reads no more than the header.
    /// @param advice  ends every message: how to get a sound file.
    LayerFile(const std::filesystem::path& path, std::string advice);
    LayerFile(LayerFile&&) noexcept;
    LayerFile& operator=(LayerFile&&) noexcept;
    ~LayerFile();

    [[nodiscard]] scene::ImageSize size() const { return size_; }
    [[nodiscard]] bool has(const std::string& name);
    [[nodiscard]] scene::Image<float> floats(const std::string& name);
    [[nodiscard]] scene::Image<std::uint32_t> integers(const std::string& name);
    /// The channel `class`. @throws scene::InputError  also for a code beyond 6.
    [[nodiscard]] scene::Image<scene::PixelClass> classes();
    /// The header's texts that begin with "gnomon:", by their names without it: "eye", "job", ….
    [[nodiscard]] std::map<std::string, std::string> texts();

private:
    struct Reader;
    [[nodiscard]] Reader& reader();
    template <typename Value>
    [[nodiscard]] scene::Image<Value> channel(const std::string& name);

    [[noreturn]] void refuse(std::string_view what) const;

    std::filesystem::path path_;
    std::string advice_;
    scene::ImageSize size_;
    std::unique_ptr<Reader> reader_;
};

} // namespace gnomon::reports
