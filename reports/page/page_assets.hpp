#pragma once

#include <string_view>

namespace gnomon::reports {

/// A part of every page, built into the program.
struct PageAsset {
    std::string_view text;
    std::string_view sha256; ///< of the text, in hexadecimal digits
};

[[nodiscard]] PageAsset page_style();
/// Our own scripts, in one.
[[nodiscard]] PageAsset page_script();
/// Chart.js with its licence; empty where it was missing when the program was built.
[[nodiscard]] PageAsset page_charts();

} // namespace gnomon::reports
