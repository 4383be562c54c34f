#pragma once

#include "reports/page/packed_blocks.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::reports {

using LayerValues = std::variant<std::vector<float>, std::vector<std::uint8_t>,
                                 std::vector<std::uint16_t>, std::vector<std::uint32_t>>;

/// A configuration whose layers were kept, and what the database says of it.
struct KeptImage {
    std::string id;
    std::uint64_t row = 0; ///< its place in the page's table
    std::uint64_t lit = 0; ///< scored pixels, by truth
    std::uint64_t blocked = 0;
    std::uint64_t false_shadow = 0;
    std::uint64_t false_lit = 0;
};

/// Configurations' layers as a page has them (docs/report.md#data).
class PageImages {
public:
    /// @param blocks  must outlive this.
    PageImages(std::filesystem::path folder, PackedBlocks& blocks)
        : folder_{std::move(folder)},
          blocks_{blocks}
    {
    }

    /// What follows from other layers bit by bit, in the arithmetic of a page, is left out and
    /// named in "derive"; depth errors are rounded to 11 bits, by less than 0.05 %.
    /// @throws scene::InputError  one line, if a file of the run is damaged, or of another
    ///                            configuration than the database says.
    /// @param step  Every step-th pixel of every step-th row is taken, from the first on; 1: all.
    [[nodiscard]] store::Json read(const KeptImage& image, int step = 1);

    /// Forgets the layers read last, whose blocks are gone.
    void forget() { last_.clear(); }

private:
    struct LastLayer {
        LayerValues values;
        store::Json block;
    };

    std::filesystem::path folder_;
    PackedBlocks& blocks_;
    /// By name: most of a configuration's layers are those of the one before.
    std::map<std::string, LastLayer> last_;
};

} // namespace gnomon::reports
