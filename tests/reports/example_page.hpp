#pragma once

#include "example_comparison.hpp"
#include "page_blocks.hpp"
#include "reports/page/report.hpp"

#include <cstddef>
#include <filesystem>
#include <string>

namespace gnomon::reports {

/// What a page must show, and not follow.
inline const std::string hostile_text =
    "</script><img src=x onerror=alert(1)> \"'&\u202e\U0001f600";

/// Writes the report of a run and reads it back.
/// @param most_image_bytes  Of all layers.
[[nodiscard]] ReadPage
written_page(const std::filesystem::path& run, const std::filesystem::path& out,
             std::size_t most_image_bytes = ReportOptions{}.most_image_bytes);

/// A run of one comparison, with its layers.
void keep_example(const std::filesystem::path& folder,
                  const analysis::Comparison& comparison = store::example().comparison);

} // namespace gnomon::reports
