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

/// Compresses numbers: differences of neighbours, taken 0, 1 or 2 times modulo 2^bits of the
/// numbers' bits, whichever is shortest (of doubles none); then as planes of bytes, the lowest byte
/// of every number first; then deflated (RFC 1950) and in base64. docs/report.md#blocks.
[[nodiscard]] PackedArray pack(std::span<const float> values);
[[nodiscard]] PackedArray pack(std::span<const double> values);
[[nodiscard]] PackedArray pack(std::span<const std::uint8_t> values);
[[nodiscard]] PackedArray pack(std::span<const std::uint16_t> values);
[[nodiscard]] PackedArray pack(std::span<const std::uint32_t> values);

/// The packed arrays of a page, equal ones once.
class PackedBlocks {
public:
    /// Adds an array and returns what a reader needs: {"block", "type", "count", "delta"}.
    store::Json add(PackedArray array);

    /// Texts, by their index in a dictionary: {"dictionary", "type": "text", …}. An empty text has
    /// no index but 4294967295.
    store::Json add_texts(std::span<const std::string> texts);

    /// The blocks' base64 texts; block "bN" is the N-th.
    [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }
    [[nodiscard]] std::size_t byte_count() const;
    /// Forgets all blocks but the first `count`.
    void keep_first(std::size_t count) { texts_.resize(count); }

private:
    std::vector<std::string> texts_;
};

} // namespace gnomon::reports
