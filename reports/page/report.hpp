#pragma once

#include "reports/page/report_options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::reports {

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
