#pragma once

#include "reports/page/packed_blocks.hpp"

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace gnomon::reports {

/// Whether a run kept the layers of a configuration.
[[nodiscard]] bool has_image(const std::filesystem::path& folder, std::string_view id);

/// A configuration's layers as a page has them (docs/report.md#data).
///
/// What follows from other layers bit by bit, in the arithmetic of a page, is left out and named in
/// "derive"; depth errors are rounded to 11 bits, by less than 0.05 %.
/// @param row  its place in the page's table.
/// @throws scene::InputError  one line, if a file of the run is damaged.
[[nodiscard]] Json read_image(const std::filesystem::path& folder, std::string_view id,
                              std::uint64_t row, PackedBlocks& blocks);

/// What `gnomon compare --json` printed for a configuration whose layers were kept.
/// @throws scene::InputError  one line, if it is damaged.
[[nodiscard]] Json read_detail(const std::filesystem::path& folder, std::string_view id);

} // namespace gnomon::reports
