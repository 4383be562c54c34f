#pragma once

#include "scene/image.hpp"
#include "store/images/exr.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::store {

/// An image file whose channels are read by name.
///
/// Every function throws scene::InputError with one line, if the file is damaged or truncated, or
/// if the channel is missing or has another type.
class ChannelFile {
public:
    ChannelFile() = default;
    ChannelFile(const ChannelFile&) = delete;
    ChannelFile& operator=(const ChannelFile&) = delete;
    virtual ~ChannelFile() = default;

    [[nodiscard]] virtual scene::ImageSize size() const = 0;
    [[nodiscard]] virtual std::vector<std::string> names() = 0;
    /// `missing` if the file lacks the channel.
    [[nodiscard]] virtual LayerType type(const std::string& name) = 0;
    /// The memory that reading takes [bytes]; all channels are decoded at once.
    [[nodiscard]] virtual std::uint64_t decoded_bytes() = 0;
    [[nodiscard]] virtual scene::Image<float> floats(const std::string& name) = 0;
    [[nodiscard]] virtual scene::Image<std::uint32_t> integers(const std::string& name) = 0;
    /// A channel of any type as float32.
    [[nodiscard]] virtual scene::Image<float> numbers(const std::string& name) = 0;

    [[nodiscard]] bool has(const std::string& name) { return type(name) != LayerType::missing; }
};

} // namespace gnomon::store
