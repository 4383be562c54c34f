#include "reports/gate/gate_report.hpp"

#include "analysis/gate/gate_filter.hpp"
#include "analysis/gate/gate_metrics.hpp"
#include "reports/gate/gate_text.hpp"
#include "reports/gate/new_pixels_picture.hpp"
#include "reports/page/page_html.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "scene/fnv1a.hpp"
#include "store/baseline/kept_wrong_pixels.hpp"
#include "store/baseline/pixel_mask.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

using analysis::GateFinding;

constexpr std::size_t most_pictures = 10;

/// Selects the new wrong pixels of a finding.
struct PixelSelection {
    analysis::PixelFilter filter;
    bool takes_false_shadow = true;
    bool takes_false_lit = true;
};

/// Empty if the finding has no pixels to show.
std::optional<PixelSelection> pixels_of_finding(const GateReport& report,
                                                const GateFinding& finding)
{
    const analysis::GateRule& rule = report.rules[finding.rule];
    const analysis::GatePair* const pair = report.outcome.pair_of(finding.entry);
    const bool is_broken =
        analysis::severity_of(finding, report.rules) == analysis::Severity::fail &&
        finding.reason != analysis::GateReason::not_available;
    if (!is_broken || pair == nullptr || report.baseline.entries[pair->before].pixels.empty() ||
        report.run.results.entries[finding.entry].pixels.empty()) {
        return std::nullopt;
    }
    if (rule.metric == analysis::new_pixels_metric) {
        return PixelSelection{finding.filter};
    }
    const auto filter = analysis::counted_pixels(rule.metric, finding.filter);
    if (!filter) {
        return std::nullopt;
    }
    return PixelSelection{*filter, analysis::counts_side(rule.metric, false),
                          analysis::counts_side(rule.metric, true)};
}

/// One configuration's pixels in the baseline and in the run.
struct ComparedPixels {
    analysis::PixelMask before;
    analysis::WrongPixels now;
    store::RgbImage ground;
};

ComparedPixels read_places(const GateReport& report, std::size_t entry)
{
    const analysis::GatePair& pair = *report.outcome.pair_of(entry);
    const analysis::GateEntry& before = report.baseline.entries[pair.before];
    const std::string& id = report.run.results.entries[entry].pixels;
    return {store::read_mask(report.baseline_file, before.pixels, store::image_size_of(before)),
            store::read_wrong_pixels(report.run.folder, id), shaded_ground(report.run.folder, id)};
}

/// The change of each pixel; empty if the images cannot be compared.
std::optional<scene::Image<PixelChange>> pixel_changes(const ComparedPixels& places,
                                                       const PixelSelection& selection)
{
    const analysis::WrongPixels& now = places.now;
    if (places.before.size() != now.mask.size() || !now.knows(selection.filter)) {
        return std::nullopt;
    }
    scene::Image<PixelChange> marks{now.mask.size()};
    for (std::size_t i = 0; i < marks.pixel_count(); ++i) {
        if (now.mask[i] == 0) {
            marks[i] = places.before[i] == 0 ? PixelChange::none : PixelChange::fixed;
        } else if (places.before[i] != 0) {
            marks[i] = PixelChange::wrong_before;
        } else if (now.is_taken(i, selection.filter) &&
                   (now.is_false_lit[i] != 0 ? selection.takes_false_lit
                                             : selection.takes_false_shadow)) {
            marks[i] = now.is_false_lit[i] != 0 ? PixelChange::new_false_lit
                                                : PixelChange::new_false_shadow;
        }
    }
    return marks;
}

std::size_t new_mark_count(const scene::Image<PixelChange>& marks)
{
    return static_cast<std::size_t>(std::count_if(marks.begin(), marks.end(), [](PixelChange mark) {
        return mark == PixelChange::new_false_shadow || mark == PixelChange::new_false_lit;
    }));
}

std::vector<std::string> heading_lines(const GateReport& report, const GateFinding& finding)
{
    const analysis::GateRule& rule = report.rules[finding.rule];
    std::vector<std::string> lines{fmt::format("{}: {} -> {}, rule \"{}\"", rule.metric,
                                               metric_text(rule.metric, finding.before),
                                               metric_text(rule.metric, finding.now), rule.id)};
    if (const std::string part = filter_text(finding.filter); !part.empty()) {
        lines.front() += ", of " + part;
    }
    lines.push_back(store::key_text(report.run.results.entries[finding.entry].key));
    const auto& changes = report.outcome.pair_of(finding.entry)->changes;
    lines.push_back(changes.empty() ? "the job is unchanged" : change_line(changes.front()));
    if (changes.size() > 1) {
        lines.back() += fmt::format(", and {} more", counted(changes.size() - 1, "change"));
    }
    return lines;
}

/// The picture with other marks.
/// @param mark_of  Maps each mark.
NewPixelsPicture remarked(NewPixelsPicture picture, PixelChange (*mark_of)(PixelChange))
{
    for (std::size_t i = 0; i < picture.marks.pixel_count(); ++i) {
        picture.marks[i] = mark_of(picture.marks[i]);
    }
    return picture;
}

PixelChange marked_before(PixelChange mark)
{
    const bool was_wrong = mark == PixelChange::fixed || mark == PixelChange::wrong_before;
    return was_wrong ? PixelChange::wrong_before : PixelChange::none;
}

PixelChange marked_after(PixelChange mark)
{
    return mark == PixelChange::fixed ? PixelChange::none : mark;
}

PixelChange marked_new(PixelChange mark)
{
    return mark == PixelChange::wrong_before ? PixelChange::none : marked_after(mark);
}

/// Wrong pixels before, after, and the new ones alone.
std::vector<HeadlinePicture> write_panels(const NewPixelsPicture& picture,
                                          const std::filesystem::path& folder)
{
    const scene::ImageSize size = page_picture_size(picture.marks.size());
    const auto write = [&](PixelChange (*mark_of)(PixelChange), std::string_view name,
                           std::string alt) {
        return write_page_picture(draw_marks(remarked(picture, mark_of), size), name,
                                  std::move(alt), folder);
    };
    return {write(marked_before, "before", "Pixels that were wrong in the baseline"),
            write(marked_after, "after", "Pixels that are wrong now"),
            write(marked_new, "new", "Pixels that became wrong")};
}

std::filesystem::path picture_path(const std::filesystem::path& folder, std::size_t number,
                                   std::string name)
{
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return !(c >= 'a' && c <= 'z') && c != '_' && c != '.'; }, '_');
    return folder / fmt::format("{:02}-{}.png", number, name);
}

/// Draws the findings by configuration.
class GatePainter {
public:
    GatePainter(GateReport& report, std::filesystem::path folder)
        : report_{report},
          folder_{std::move(folder)}
    {
    }

    /// Draws the finding, unless it has no pixels or shares another finding's picture.
    void paint(std::size_t index)
    {
        const GateFinding& finding = report_.outcome.findings[index];
        const auto shown = pixels_of_finding(report_, finding);
        if (!shown) {
            return;
        }
        if (!places_ || compared_entry_ != finding.entry) {
            places_ = read_places(report_, finding.entry);
            compared_entry_ = finding.entry;
        }
        auto marks = pixel_changes(*places_, *shown);
        if (!marks || new_mark_count(*marks) == 0) {
            return;
        }
        scene::Fnv1a hash;
        hash.add(marks->data(), marks->pixel_count());
        const std::pair key{finding.entry, hash.value()};
        if (!known_.contains(key) && known_.size() < most_pictures) {
            known_.emplace(key, write_picture_of(finding, places_->ground, std::move(*marks)));
        }
        if (const auto found = known_.find(key); found != known_.end()) {
            report_.pictures.emplace(index, found->second);
        }
    }

    [[nodiscard]] bool is_full() const { return known_.size() >= most_pictures; }

private:
    std::filesystem::path write_picture_of(const GateFinding& finding,
                                           const store::RgbImage& ground,
                                           scene::Image<PixelChange> marks)
    {
        NewPixelsPicture picture;
        picture.ground = ground;
        picture.marks = std::move(marks);
        picture.title = fmt::format("{} that were right in the baseline",
                                    counted(new_mark_count(picture.marks), "wrong pixel"));
        picture.lines = heading_lines(report_, finding);
        store::make_folder(folder_);
        auto path = picture_path(folder_, known_.size() + 1, report_.rules[finding.rule].metric);
        store::write_file(path, store::encode_png(draw_new_pixels_picture(picture)));
        if (report_.panels.empty()) {
            report_.panels = write_panels(picture, folder_);
        }
        return path;
    }

    GateReport& report_;
    std::filesystem::path folder_;
    std::optional<ComparedPixels> places_;
    std::size_t compared_entry_ = 0;
    std::map<std::pair<std::size_t, std::uint64_t>, std::filesystem::path> known_;
};

} // namespace

void write_gate_pictures(GateReport& report, const std::filesystem::path& folder)
{
    constexpr std::size_t most_findings = 50; // most of them share pictures
    GatePainter painter{report, folder};
    const std::size_t count = std::min(report.outcome.findings.size(), most_findings);
    for (std::size_t i = 0; i < count && !painter.is_full(); ++i) {
        painter.paint(i);
    }
}

} // namespace gnomon::reports
