#include "store/baseline/baseline_write.hpp"

#include "scene/error.hpp"
#include "scene/one_line.hpp"
#include "store/baseline/baseline_json.hpp"
#include "store/baseline/kept_wrong_pixels.hpp"
#include "store/baseline/pixel_mask.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace gnomon::store {

namespace {

/// The run's results with the mask's name, by `name_mask`, where the pixels of all were kept: those
/// that a sweep keeps of its best and worst are others' in the next run.
template <typename NameMask>
analysis::GateEntries with_names(const GateRun& run, const NameMask& name_mask)
{
    analysis::GateEntries results = run.results;
    const bool keeps_all = std::ranges::none_of(
        results.entries, [](const analysis::GateEntry& entry) { return entry.pixels.empty(); });
    for (analysis::GateEntry& entry : results.entries) {
        entry.pixels =
            keeps_all ? name_mask(read_wrong_pixels(run.folder, entry.pixels).mask) : std::string{};
    }
    return results;
}

} // namespace

analysis::GateEntries with_mask_names(const GateRun& run)
{
    return with_names(run, mask_name);
}

analysis::GateEntries write_masks(const std::filesystem::path& baseline, const GateRun& run)
{
    return with_names(run,
                      [&](const analysis::PixelMask& mask) { return write_mask(baseline, mask); });
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

} // namespace gnomon::store
