#pragma once

#include "analysis/lookup/footprint.hpp"
#include "renderers/light_queries.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Numbers the texels of a set. Texels of an 8×8 block are numbered in Z-order, so that sixteen in
/// a row are usually 4×4 neighbours.
class TexelIndex {
public:
    /// @param texels  In any order, with repetitions; coordinates >= 0.
    explicit TexelIndex(std::span<const scene::Texel> texels);

    /// The texels, in the order of their numbers.
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
    /// Small, since sparse sets touch nearly as many blocks as they have texels.
    struct Block {
        std::uint64_t places = 0; ///< bit mask of the texels in the set
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

    /// Finds the range of blocks that covers all texels.
    void frame(std::span<const scene::Texel> texels);
    void mark(std::span<const scene::Texel> texels);
    void number();

    int first_column_ = 0; ///< in blocks
    int first_row_ = 0;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;                ///< in each map
    std::vector<std::uint32_t> block_at_; ///< by cell: index into `blocks_`, or `none`
    std::vector<Block> blocks_; ///< the blocks with texels, in the order in which they were found
    std::vector<scene::Texel> origins_; ///< of each block
    std::vector<scene::Texel> texels_;
};

/// Finds the first hits of texels, in their order.
using FindFirstHits =
    std::function<std::vector<renderers::TexelHit>(std::span<const scene::Texel> texels)>;

/// The first surface that the light sees through each texel of a set. Traces each texel once.
class TexelHits {
public:
    /// @param texels  Of the map, in any order, with repetitions.
    TexelHits(const renderers::LightQueries& light, std::span<const scene::Texel> texels,
              renderers::HitDetail detail);
    /// @param find  Finds the first hits of texels.
    TexelHits(std::span<const scene::Texel> texels, const FindFirstHits& find);

    /// Index of the texel's hit. Precondition: the texel was given.
    [[nodiscard]] std::size_t number_of(const scene::Texel& texel) const { return index_[texel]; }
    [[nodiscard]] const renderers::TexelHit& by_number(std::size_t number) const
    {
        return hits_[number];
    }
    [[nodiscard]] const scene::Texel& texel(std::size_t number) const
    {
        return index_.texels()[number];
    }
    /// Null if the texel was not given.
    [[nodiscard]] const renderers::TexelHit* find(const scene::Texel& texel) const
    {
        return index_.has(texel) ? &hits_[index_[texel]] : nullptr;
    }
    /// Precondition: the texel was given.
    [[nodiscard]] const renderers::TexelHit& operator[](const scene::Texel& texel) const
    {
        return hits_[index_[texel]];
    }

private:
    TexelIndex index_;
    std::vector<renderers::TexelHit> hits_;
};

/// The texels that the taps read.
[[nodiscard]] std::vector<scene::Texel> texels_of(std::span<const Tap> taps);

} // namespace gnomon::analysis
