#pragma once

#include "scene/image.hpp"

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

/// One of the three pictures of the first screen: drawn, true, wrong.
struct HeadlinePicture {
    std::string file; ///< in DIR: "pictures/drawn.png"
    std::string alt;  ///< alternative text
    scene::ImageSize size;
    std::string address; ///< data: URL
};

struct ReportOptions {
    std::filesystem::path folder; ///< RUN
    std::filesystem::path out;    ///< DIR, which exists
    std::vector<ReportFigure> figures;
    std::string no_figures;        ///< why those that were asked for are missing
    std::vector<std::string> only; ///< ids of the configurations to embed; empty: as many as fit
    std::filesystem::path against; ///< an earlier run to compare with; may be empty
    std::size_t most_image_bytes = 11'000'000; ///< of all layers, as the page stores them
};

} // namespace gnomon::reports
