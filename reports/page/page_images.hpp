#pragma once

#include "reports/page/packed_blocks.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::reports {

/// Whether a run kept the layers of a configuration.
[[nodiscard]] bool has_image(const std::filesystem::path& folder, std::string_view id);

using LayerValues = std::variant<std::vector<float>, std::vector<std::uint8_t>,
                                 std::vector<std::uint16_t>, std::vector<std::uint32_t>>;

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
    /// @param row  its place in the page's table.
    /// @throws scene::InputError  one line, if a file of the run is damaged.
    [[nodiscard]] Json read(std::string_view id, std::uint64_t row);

    /// Forgets the layers read last, whose blocks are gone.
    void forget() { last_.clear(); }

private:
    struct LastLayer {
        LayerValues values;
        Json block;
    };

    std::filesystem::path folder_;
    PackedBlocks& blocks_;
    /// By name: most of a configuration's layers are those of the one before.
    std::map<std::string, LastLayer> last_;
};

/// What `gnomon compare --json` printed for a configuration whose layers were kept.
/// @throws scene::InputError  one line, if it is damaged.
[[nodiscard]] Json read_detail(const std::filesystem::path& folder, std::string_view id);

} // namespace gnomon::reports
