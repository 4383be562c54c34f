#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon::scene {

/// The 64-bit FNV-1a hash. Tells contents apart; not safe against an adversary.
/// Source: G. Fowler, L. C. Noll, K.-P. Vo, http://www.isthe.com/chongo/tech/comp/fnv/.
class Fnv1a {
public:
    void add(const void* bytes, std::size_t count)
    {
        const auto* byte = static_cast<const unsigned char*>(bytes);
        for (std::size_t i = 0; i < count; ++i) {
            hash_ = (hash_ ^ byte[i]) * 0x100000001b3ULL;
        }
    }
    /// Adds the text and its end, so that neighbouring texts do not run into each other.
    void add(std::string_view text)
    {
        add(text.data(), text.size());
        add("", 1);
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

} // namespace gnomon::scene
