#include "reports/gate/baseline_write.hpp"

#include "reports/gate/baseline_json.hpp"
#include "reports/gate/kept_wrong_pixels.hpp"
#include "reports/gate/pixel_mask.hpp"
#include "reports/output_file.hpp"
#include "scene/error.hpp"
#include "scene/job_toml.hpp"

#include <fmt/format.h>

#include <string>

namespace gnomon::reports {

analysis::GateEntries with_mask_names(const GateRun& run)
{
    analysis::GateEntries results = run.results;
    for (analysis::GateEntry& entry : results.entries) {
        if (!entry.pixels.empty()) {
            entry.pixels = mask_name(read_wrong_pixels(run.folder, entry.pixels).mask);
        }
    }
    return results;
}

analysis::GateEntries write_masks(const std::filesystem::path& baseline, const GateRun& run)
{
    analysis::GateEntries results = run.results;
    for (analysis::GateEntry& entry : results.entries) {
        if (!entry.pixels.empty()) {
            entry.pixels = write_mask(baseline, read_wrong_pixels(run.folder, entry.pixels).mask);
        }
    }
    return results;
}

void write_baseline(const std::filesystem::path& file, const analysis::GateEntries& entries)
{
    const std::string text = baseline_json(entries);
    if (text.size() > most_baseline_bytes) {
        throw scene::InputError(fmt::format(
            "{}: {} configurations are too many for a baseline of at most {} MiB: sweep fewer",
            scene::one_line(file.string()), entries.entries.size(), most_baseline_bytes >> 20U));
    }
    write_file(file, text);
    remove_other_masks(file, entries);
}

} // namespace gnomon::reports
