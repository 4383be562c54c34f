#pragma once

#include "reports/page/report_options.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::reports {

/// The result of `write_report`.
struct ReportOutcome {
    std::size_t images = 0;            ///< configurations with layers in the page
    std::size_t images_left_out = 0;   ///< configurations whose layers did not fit
    std::vector<std::string> problems; ///< damaged layers, which are left out
    std::string schema;                ///< a note on an older run's schema, or empty
};

/// Writes the CSV files of a run, from which figures are drawn, into DIR.
/// @throws  as `write_report`.
void write_report_csv(const std::filesystem::path& folder, const std::filesystem::path& out);

/// Writes report.html and summary.md of a run into DIR, each atomically (docs/report.md).
///
/// The page needs no network and no server. Its layers take at most `most_image_bytes`, those of
/// the headline configuration first; if these do not fit, every second, fourth or eighth pixel.
/// Damaged layers are left out, unless `only` requests them.
/// @throws scene::InputError        if there is no run, it is damaged, or it lacks the layers of a
///                                  configuration in `only`.
/// @throws scene::EnvironmentError  if a file cannot be written.
ReportOutcome write_report(const ReportOptions& options);

} // namespace gnomon::reports
