#pragma once

#include "scene/image.hpp"
#include "store/images/exr.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::store {

/// A file of an image whose channels are read by their names.
///
/// Every function throws scene::InputError, one line, if the file is damaged or truncated, or if
/// the channel is missing or of another type.
class ChannelFile {
public:
    ChannelFile() = default;
    ChannelFile(const ChannelFile&) = delete;
    ChannelFile& operator=(const ChannelFile&) = delete;
    virtual ~ChannelFile() = default;

    [[nodiscard]] virtual scene::ImageSize size() const = 0;
    [[nodiscard]] virtual std::vector<std::string> names() = 0;
    /// `missing` if the file has no such channel.
    [[nodiscard]] virtual LayerType type(const std::string& name) = 0;
    /// What reading a channel takes, for all of them are decoded at once [bytes].
    [[nodiscard]] virtual std::uint64_t decoded_bytes() = 0;
    [[nodiscard]] virtual scene::Image<float> floats(const std::string& name) = 0;
    [[nodiscard]] virtual scene::Image<std::uint32_t> integers(const std::string& name) = 0;
    /// A channel of any type that `type` names, as float32.
    [[nodiscard]] virtual scene::Image<float> numbers(const std::string& name) = 0;

    [[nodiscard]] bool has(const std::string& name) { return type(name) != LayerType::missing; }
};

} // namespace gnomon::store
