#pragma once

#include "renderers/light_queries.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Numbers the texels of a set, each once: those of a block of 8×8 in Z-order, so that sixteen in a
/// row are as a rule 4×4 neighbours.
class TexelIndex {
public:
    /// @param texels  in any order, repetitions included; coordinates >= 0.
    explicit TexelIndex(std::span<const scene::Texel> texels);

    /// The set, by number.
    [[nodiscard]] const std::vector<scene::Texel>& texels() const { return texels_; }
    /// Whether the texel is in the set.
    [[nodiscard]] bool has(const scene::Texel& texel) const
    {
        const int column = (texel.x >> side_bits) - first_column_;
        const int row = (texel.y >> side_bits) - first_row_;
        if (column < 0 || row < 0 || static_cast<std::size_t>(column) >= columns_ ||
            static_cast<std::size_t>(row) >= rows_) {
            return false;
        }
        const std::size_t cell = cell_of(texel);
        return cell < block_at_.size() && block_at_[cell] != none &&
               (blocks_[block_at_[cell]].places >> place_of(texel) & 1U) != 0;
    }
    /// Precondition: the texel is in the set.
    [[nodiscard]] std::size_t operator[](const scene::Texel& texel) const
    {
        const Block& block = blocks_[block_at_[cell_of(texel)]];
        const std::uint64_t before = (std::uint64_t{1} << place_of(texel)) - 1;
        return block.first + static_cast<std::size_t>(std::popcount(block.places & before));
    }

private:
    static constexpr int side_bits = 3;
    static constexpr int side = 1 << side_bits;
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    /// Sparse sets touch as many blocks as they have texels, so a block is small.
    struct Block {
        std::uint64_t places = 0; ///< those of its texels: bits
        std::uint32_t first = 0;  ///< number of its first texel
    };

    [[nodiscard]] std::size_t cell_of(const scene::Texel& texel) const
    {
        return (static_cast<std::size_t>(texel.map) * rows_ +
                static_cast<std::size_t>((texel.y >> side_bits) - first_row_)) *
                   columns_ +
               static_cast<std::size_t>((texel.x >> side_bits) - first_column_);
    }
    /// The texel's place in its block's Z-order.
    [[nodiscard]] static std::size_t place_of(const scene::Texel& texel)
    {
        constexpr std::array<std::uint8_t, side> spread{0, 1, 4, 5, 16, 17, 20, 21};
        return static_cast<std::size_t>(spread[static_cast<std::size_t>(texel.x % side)] |
                                        spread[static_cast<std::size_t>(texel.y % side)] << 1);
    }

    /// Finds the blocks around all texels.
    void frame(std::span<const scene::Texel> texels);
    void mark(std::span<const scene::Texel> texels);
    void number();

    int first_column_ = 0; ///< of blocks
    int first_row_ = 0;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;                ///< of each map
    std::vector<std::uint32_t> block_at_; ///< [cell], or `none`
    std::vector<Block> blocks_;           ///< those with texels, as they are first met
    std::vector<scene::Texel> origins_;   ///< of each block
    std::vector<scene::Texel> texels_;
};

} // namespace gnomon::analysis
