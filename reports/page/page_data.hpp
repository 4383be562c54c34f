#pragma once

#include "reports/page/packed_blocks.hpp"
#include "store/run/run_reader.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::reports {

/// A run's configurations as the page stores them (docs/report.md#data).
struct PageTable {
    store::Json columns; ///< {"count", "columns"}: columns in which rows differ
    store::Json constants =
        store::Json::object(); ///< the other columns that have a value, as texts
};

/// Larger tables omit the ids, which hardly compress.
inline constexpr std::size_t most_rows_with_ids = 20'000;

[[nodiscard]] PageTable read_table(const store::RunReader& run, PackedBlocks& blocks);

/// Ids of the finished curves, in sweep order.
[[nodiscard]] std::vector<std::string> curve_ids(const store::RunReader& run);

/// The bias curves with their exact counts. Beyond 400,000 points in all, each curve keeps every
/// n-th point and its last, with exact counts.
[[nodiscard]] store::Json read_curves(const store::RunReader& run,
                                      const std::vector<std::string>& curves, PackedBlocks& blocks);

/// Errors by light distance, for as many curves as fit into 60,000 rows.
[[nodiscard]] store::Json read_error_vs_z(const store::RunReader& run,
                                          const std::vector<std::string>& curves,
                                          PackedBlocks& blocks);

using LayerValues = std::variant<std::vector<float>, std::vector<std::uint8_t>,
                                 std::vector<std::uint16_t>, std::vector<std::uint32_t>>;

/// A configuration whose layers were kept, and its counts from the database.
struct KeptImage {
    std::string id;
    std::uint64_t row = 0; ///< its index in the page's table
    std::uint64_t lit = 0; ///< scored pixels, by truth
    std::uint64_t blocked = 0;
    std::uint64_t false_shadow = 0;
    std::uint64_t false_lit = 0;
};

/// Layers of configurations as the page stores them (docs/report.md#data).
class PageImages {
public:
    /// @param blocks  must outlive this.
    PageImages(std::filesystem::path folder, PackedBlocks& blocks)
        : folder_{std::move(folder)},
          blocks_{blocks}
    {
    }

    /// Reads a configuration's layers. Layers that the page can derive bit for bit from others are
    /// omitted and named in "derive"; depth errors are rounded to 11 bits, by less than 0.05 %.
    /// @param step  Takes every step-th pixel of every step-th row, from the first on.
    /// @throws scene::InputError  one line, if a file of the run is damaged, or belongs to another
    ///                            configuration than the database says.
    [[nodiscard]] store::Json read(const KeptImage& image, int step = 1);

    /// Forgets the last layers after their blocks were dropped.
    void forget() { last_.clear(); }

private:
    struct LastLayer {
        LayerValues values;
        store::Json block;
    };

    std::filesystem::path folder_;
    PackedBlocks& blocks_;
    /// By name; consecutive configurations share most of their layers.
    std::map<std::string, LastLayer> last_;
};

} // namespace gnomon::reports
