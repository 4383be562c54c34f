#pragma once

#include "analysis/comparison/comparison.hpp"
#include "reports/pictures/panels.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::reports {

/// A line below a panel: an optional swatch, a name, a rate and its counts.
struct CaptionLine {
    std::string name;
    std::string value;
    std::string detail;
    std::optional<Mark> mark;
};

/// The texts of a panel.
struct Caption {
    std::string title;
    std::vector<CaptionLine> lines;
};

/// The settings of GL's lookup. Of another renderer's case only the settings that it gives, and the
/// renderer's own keys.
[[nodiscard]] Caption shown_caption(const analysis::Comparison& comparison);

[[nodiscard]] Caption truth_caption(const analysis::Comparison& comparison);

[[nodiscard]] Caption error_caption(const analysis::Metrics& metrics);

/// The recommended constant bias, and the errors that it leaves.
/// @param recommended  That of the comparison.
[[nodiscard]] Caption after_caption(const analysis::Comparison& comparison,
                                    const analysis::Recommendation& recommended);

} // namespace gnomon::reports
