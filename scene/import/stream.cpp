#include "scene/import/stream.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace gnomon::scene {

namespace {

constexpr std::size_t block_bytes = 1U << 20U;

std::size_t padded(std::size_t byte_count)
{
    return (byte_count + 7) / 8 * 8;
}

} // namespace

void ImportWriter::put_bytes(std::span<const std::byte> bytes)
{
    const std::size_t padding = padded(bytes.size()) - bytes.size();
    while (!bytes.empty()) {
        const std::size_t count = std::min(bytes.size(), block_bytes);
        block_.insert(block_.end(), bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(count));
        bytes = bytes.subspan(count);
        if (block_.size() >= block_bytes) {
            flush();
        }
    }
    block_.insert(block_.end(), padding, std::byte{0});
}

void ImportWriter::flush()
{
    std::span<const std::byte> bytes{block_};
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
        if (written <= 0 && errno != EINTR) {
            throw std::runtime_error{"write failed"};
        }
        bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
    block_.clear();
}

void ImportReader::skip(std::uint64_t byte_count)
{
    // The last array of a stream may lack its padding.
    const std::size_t count = padded(static_cast<std::size_t>(byte_count));
    rest_ = rest_.subspan(std::min(count, rest_.size()));
}

} // namespace gnomon::scene
