#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::reports {

/// A figure that was drawn for a report.
struct ReportFigure {
    std::string name;
    std::string title;
    std::string caption; ///< the measured settings
    std::string alt;     ///< alternative text
    std::string svg;     ///< file names in DIR/figures
    std::string png;
};

struct ReportOptions {
    std::filesystem::path folder; ///< RUN
    std::filesystem::path out;    ///< DIR, which exists
    std::vector<ReportFigure> figures;
    std::string no_figures;        ///< why there are none
    std::vector<std::string> only; ///< ids of the configurations to embed; empty: as many as fit
    std::size_t most_image_bytes = 11'000'000; ///< of all layers, as the page stores them
};

} // namespace gnomon::reports
