#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::reports {

/// A figure that was drawn for a report.
struct ReportFigure {
    std::string name;
    std::string title;
    std::string caption; ///< the settings that it was measured with
    std::string alt;     ///< what it shows, in words
    std::string svg;     ///< file names in DIR/figures
    std::string png;
};

struct ReportOptions {
    std::filesystem::path folder; ///< RUN
    std::filesystem::path out;    ///< DIR, which exists
    std::vector<ReportFigure> figures;
    std::string no_figures;        ///< why there are none; empty if there are
    std::vector<std::string> only; ///< ids of the configurations to embed; empty: as many as fit
    std::size_t most_image_bytes = 11'000'000; ///< of all layers, as the page has them
};

/// What was written.
struct ReportOutcome {
    std::size_t images = 0;            ///< configurations whose layers the page holds
    std::size_t images_left_out = 0;   ///< whose layers were kept but did not fit
    std::vector<std::string> problems; ///< of kept layers that are damaged: they are left out
    std::string schema;                ///< what is to be said of an older run's; else empty
};

/// Writes the CSV files of a run into DIR, from which figures are drawn.
/// @throws  as `write_report`.
void write_report_csv(const std::filesystem::path& folder, const std::filesystem::path& out);

/// Writes report.html and summary.md of a run into DIR, each atomically (docs/report.md).
///
/// The page needs no network and no server. Its layers take `most_image_bytes`, those of the
/// headline configuration first; where these do not fit, every second, fourth or eighth pixel of
/// them. Kept layers that are damaged are left out, unless `only` asks for them.
/// @throws scene::InputError        if there is no run, it is damaged, or it does not hold the
///                                  layers of a configuration in `only`.
/// @throws scene::EnvironmentError  if a file cannot be written.
ReportOutcome write_report(const ReportOptions& options);

} // namespace gnomon::reports
