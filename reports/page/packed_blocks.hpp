#pragma once

#include "store/json.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

/// An array of numbers, compressed.
struct PackedArray {
    std::string text; ///< base64
    std::string_view type;
    std::size_t count = 0;
    int differences = 0;
};

/// Compresses numbers (docs/report.md#blocks): takes differences of neighbours 0, 1 or 2 times,
/// modulo 2^bits, whichever is shortest (doubles: never); writes byte planes, the lowest byte of
/// every number first; deflates them (RFC 1950) and encodes the result in base64.
[[nodiscard]] PackedArray pack(std::span<const float> values);
[[nodiscard]] PackedArray pack(std::span<const double> values);
[[nodiscard]] PackedArray pack(std::span<const std::uint8_t> values);
[[nodiscard]] PackedArray pack(std::span<const std::uint16_t> values);
[[nodiscard]] PackedArray pack(std::span<const std::uint32_t> values);

/// The packed arrays of a page; equal arrays share a block.
class PackedBlocks {
public:
    /// Adds an array and returns its description: {"block", "type", "count", "delta"}.
    store::Json add(PackedArray array);

    /// Adds texts as indices into a dictionary: {"dictionary", "type": "text", …}. An empty text
    /// has the index 4294967295.
    store::Json add_texts(std::span<const std::string> texts);

    /// The base64 text of each block; "bN" names the N-th.
    [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }
    [[nodiscard]] std::size_t byte_count() const;
    /// Drops all blocks after the first `count`.
    void keep_first(std::size_t count) { texts_.resize(count); }

private:
    std::vector<std::string> texts_;
};

/// Base64 (RFC 4648) with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

} // namespace gnomon::reports
