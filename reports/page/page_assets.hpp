#pragma once

#include <string_view>

namespace gnomon::reports {

/// A part of every page, embedded in the program.
struct PageAsset {
    std::string_view text;
    std::string_view sha256; ///< of the text, in hexadecimal digits
};

[[nodiscard]] PageAsset page_style();
/// Gnomon's scripts, concatenated.
[[nodiscard]] PageAsset page_script();
/// Chart.js with its licence; empty if the build lacked it.
[[nodiscard]] PageAsset page_charts();

} // namespace gnomon::reports
