#include "reports/gate/new_pixels_picture.hpp"
#include "reports/page/page_html.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "store/images/layer_file.hpp"
#include "store/run/run_commands.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

using scene::PixelClass;

/// If the truth differs at more than one pixel in this many, another picture was taken.
constexpr std::uint64_t most_other_truth = 10;

/// The truth and the verdict of a configuration's pixels.
struct Verdicts {
    scene::Image<PixelClass> classes;
    scene::Image<float> verdicts;

    [[nodiscard]] bool is_wrong(std::size_t i) const
    {
        return scene::is_false_shadow(classes[i], verdicts[i]) ||
               scene::is_false_lit(classes[i], verdicts[i]);
    }
};

/// Empty if the pixels were not kept, or are damaged.
std::optional<Verdicts> read_verdicts(const std::filesystem::path& run, const std::string& id)
{
    if (!store::has_image(run, id)) {
        return std::nullopt;
    }
    try {
        store::LayerFile file{store::pixels_path(run, id), ""};
        return Verdicts{file.classes(), file.floats("verdict")};
    } catch (const scene::InputError&) {
        return std::nullopt;
    }
}

PixelChange change_of(const Verdicts& before, const Verdicts& now, std::size_t i)
{
    const bool was_wrong = before.is_wrong(i);
    if (!now.is_wrong(i)) {
        return was_wrong ? PixelChange::fixed : PixelChange::none;
    }
    if (was_wrong) {
        return PixelChange::wrong_before;
    }
    return scene::is_lit(now.verdicts[i]) ? PixelChange::new_false_lit
                                          : PixelChange::new_false_shadow;
}

/// How the pixels changed.
struct Changes {
    scene::Image<PixelChange> marks;
    std::uint64_t fixed = 0;
    std::uint64_t became_wrong = 0;
    std::uint64_t other_truth = 0; ///< pixels whose class differs
};

Changes changes_of(const Verdicts& before, const Verdicts& now)
{
    Changes changes{scene::Image<PixelChange>{now.classes.size()}};
    for (std::size_t i = 0; i < now.classes.pixel_count(); ++i) {
        const PixelChange change = change_of(before, now, i);
        changes.marks[i] = change;
        changes.fixed += std::uint64_t{change == PixelChange::fixed};
        changes.became_wrong += std::uint64_t{change == PixelChange::new_false_lit ||
                                              change == PixelChange::new_false_shadow};
        changes.other_truth += std::uint64_t{before.classes[i] != now.classes[i]};
    }
    return changes;
}

std::string id_of(const RunOverview& overview)
{
    return overview.headline->result.text("id");
}

std::string change_row(std::string_view name, const std::string& before, const std::string& now)
{
    return fmt::format("<tr>{}{}{}</tr>\n", row_heading(name), number_cell(before),
                       number_cell(now));
}

/// Keys whose values differ, or that only one job has.
std::string key_rows(const store::ResultRow& before, const store::ResultRow& now)
{
    const auto was = store::job_settings(before);
    const auto is = store::job_settings(now);
    const auto find = [](const auto& settings, const std::string& key) {
        const auto found = std::ranges::find(
            settings, key, [](const auto& setting) -> const std::string& { return setting.first; });
        return found == settings.end() ? std::string{"–"} : found->second;
    };
    std::string html;
    for (const auto& [key, value] : was) {
        if (find(is, key) != value) {
            html += change_row(key, value, find(is, key));
        }
    }
    for (const auto& [key, value] : is) {
        if (find(was, key) == "–") {
            html += change_row(key, "–", value);
        }
    }
    return html.empty() ? "<tr><th scope=\"row\">no key differs</th><td></td><td></td></tr>\n"
                        : html;
}

std::string result_rows(const store::ResultRow& before, const store::ResultRow& now)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> rates{
        {{"scored pixels that are wrong", "error_rate"},
         {"lit pixels that are shadowed", "false_shadow_rate"},
         {"shadowed pixels that are lit", "false_lit_rate"},
         {"mean error", "mean_abs_error"}}};
    std::string html;
    for (const auto& [name, column] : rates) {
        html += change_row(name, percent(before.number(column)), percent(now.number(column)));
    }
    for (const KindColumns& label : label_columns()) {
        const auto text = [&](const store::ResultRow& row) {
            return has_causes(row) ? grouped(row.count(label.count)) : std::string{"–"};
        };
        html += before.count(label.count) + now.count(label.count) == 0
                    ? std::string{}
                    : change_row(label.name + " [px]", text(before), text(now));
    }
    return html;
}

std::string changes_text(const Changes& changes)
{
    std::string text = fmt::format("{} became wrong, and {} right.",
                                   counted(changes.became_wrong, "pixel"), grouped(changes.fixed));
    if (changes.other_truth > 0) {
        text += fmt::format(" The truth itself differs at {}: the scene, the camera or the light "
                            "changed.",
                            counted(changes.other_truth, "pixel"));
    }
    return text;
}

/// Which pixels changed, in words and as a picture.
struct DrawnChanges {
    std::string words;
    std::optional<HeadlinePicture> picture = {};
};

DrawnChanges draw_changes(const ComparedRun& before, const ComparedRun& now,
                          const std::filesystem::path& out)
{
    const auto was = read_verdicts(before.run.folder(), id_of(before.overview));
    const auto is = read_verdicts(now.run.folder(), id_of(now.overview));
    if (!was || !is) {
        return {"Pixels cannot be compared: a run did not keep those of its headline."};
    }
    if (was->classes.size() != is->classes.size()) {
        return {"Pixels cannot be compared: the images differ in size."};
    }
    const Changes changes = changes_of(*was, *is);
    if (most_other_truth * changes.other_truth > changes.marks.pixel_count()) {
        return {fmt::format("Pixels cannot be compared: the truth itself differs at {}, so the "
                            "scene, the camera or the light changed.",
                            counted(changes.other_truth, "pixel"))};
    }
    const NewPixelsPicture picture{"Pixels that changed",
                                   {},
                                   shaded_ground(now.run.folder(), id_of(now.overview)),
                                   changes.marks};
    return {changes_text(changes),
            write_page_picture(draw_new_pixels_picture(picture), "changed",
                               "Pixels that became wrong, and those that became right", out)};
}

/// ", its best configuration: shadow_map.resolution = 2048"; empty if the run has only one.
std::string of_run(const RunOverview& overview)
{
    const std::string& settings = overview.headline->settings;
    return settings.empty()
               ? std::string{}
               : fmt::format(", its headline configuration: <bdi>{}</bdi>", escaped(settings));
}

} // namespace

std::string against_section(const ComparedRun& before, const ComparedRun& now,
                            const std::filesystem::path& out)
{
    const auto [words, picture] = draw_changes(before, now, out);
    const store::ResultRow& was = before.overview.headline->result;
    const store::ResultRow& is = now.overview.headline->result;
    std::string html = fmt::format(
        "<section id=\"against\" data-nav=\"Before and now\" aria-labelledby=\"against-heading\">\n"
        "<h2 id=\"against-heading\">Before and now</h2>\n<p>Before is <bdi>{}</bdi>{}. {}</p>\n",
        escaped(before.run.folder().string()), of_run(before.overview), escaped(words));
    html += "<div class=\"two\">\n" + table_head("Results", {"", "before", "now"}) +
            result_rows(was, is) + std::string{table_end};
    html += table_head("Changed settings", {"key", "before", "now"}) + key_rows(was, is) +
            std::string{table_end} + "</div>\n";
    if (picture) {
        html +=
            fmt::format("<figure><img src=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\"></figure>"
                        "\n",
                        picture->address, escaped(picture->alt), picture->size.width_px,
                        picture->size.height_px);
    }
    return html + "</section>\n";
}

} // namespace gnomon::reports
