#include "reports/page/report.hpp"

#include "analysis/results/metric_table.hpp"
#include "reports/page/packed_blocks.hpp"
#include "reports/page/page_data.hpp"
#include "reports/page/page_html.hpp"
#include "reports/page/run_overview.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/csv/run_csv.hpp"
#include "store/json_values.hpp"
#include "store/output_file.hpp"
#include "store/run/run_schema.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

namespace gnomon::reports {

namespace {

constexpr int largest_step = 8; ///< every eighth pixel fits at any size that GL can draw

std::string data_address(const std::filesystem::path& png)
{
    std::ifstream file{png, std::ios::binary};
    const std::string bytes{std::istreambuf_iterator<char>{file}, std::istreambuf_iterator<char>{}};
    if (bytes.empty()) {
        throw scene::EnvironmentError(
            fmt::format("{}: cannot be read; check the folder", png.string()));
    }
    return "data:image/png;base64," + base64(std::as_bytes(std::span{bytes}));
}

/// The images in `only`, or all: the headline's first, then in sweep order.
std::vector<KeptImage> kept_images(const store::RunReader& run, const RunOverview& overview,
                                   const ReportOptions& options)
{
    std::vector<KeptImage> kept;
    store::sqlite::Statement find{
        run.database(), "SELECT id, \"pixels.lit\", \"pixels.blocked\", false_shadow, false_lit"
                        " FROM results ORDER BY ordinal"};
    const auto count = [&](int column) { return static_cast<std::uint64_t>(find.integer(column)); };
    for (std::uint64_t row = 0; find.step(); ++row) {
        const std::string id = find.text(0);
        const bool is_asked_for =
            options.only.empty() ||
            std::find(options.only.begin(), options.only.end(), id) != options.only.end();
        if (is_asked_for && store::has_image(run.folder(), id)) {
            kept.push_back({id, row, count(1), count(2), count(3), count(4)});
        }
    }
    std::stable_partition(kept.begin(), kept.end(), [&](const KeptImage& image) {
        return overview.headline && image.row == overview.headline->row;
    });
    return kept;
}

void require_kept(const std::vector<KeptImage>& kept, const ReportOptions& options)
{
    for (const std::string& id : options.only) {
        if (std::none_of(kept.begin(), kept.end(),
                         [&](const KeptImage& image) { return image.id == id; })) {
            throw scene::InputError(fmt::format(
                "--configuration {}: {} has no layers of it; results.csv lists the ids, and "
                "`gnomon sweep --keep-pixels` keeps layers",
                scene::one_line(id), scene::one_line(options.folder.string())));
        }
    }
}

/// The image; null if its files are damaged and `only` does not name it.
store::Json read_image(PageImages& layers, const KeptImage& image, int step,
                       const ReportOptions& options, ReportOutcome& outcome)
{
    try {
        return layers.read(image, step);
    } catch (const scene::InputError& error) {
        if (!options.only.empty()) {
            throw;
        }
        outcome.problems.emplace_back(error.what());
        return nullptr;
    }
}

/// As many images as fit. The first is always included, thinned if necessary.
store::Json read_images(const store::RunReader& run, const std::vector<KeptImage>& kept,
                        const ReportOptions& options, PackedBlocks& blocks, ReportOutcome& outcome)
{
    store::Json images = store::Json::array();
    const std::size_t before = blocks.byte_count();
    PageImages layers{run.folder(), blocks};
    for (const KeptImage& image : kept) {
        const std::size_t block_count = blocks.texts().size();
        const auto is_too_large = [&] {
            return blocks.byte_count() - before > options.most_image_bytes;
        };
        store::Json entry = read_image(layers, image, 1, options, outcome);
        for (int step = 2; images.empty() && is_too_large() && step <= largest_step; step *= 2) {
            blocks.keep_first(block_count);
            layers.forget();
            entry = read_image(layers, image, step, options, outcome);
        }
        if (!entry.is_null() && !images.empty() && is_too_large()) {
            blocks.keep_first(block_count);
            layers.forget();
            ++outcome.images_left_out;
        } else if (!entry.is_null()) {
            images.push_back(std::move(entry));
            ++outcome.images;
        }
    }
    return images;
}

store::Json run_object(const store::RunReader& run)
{
    const store::RunDescription& description = run.description();
    const store::PlanOutcome& outcome = run.outcome();
    return {{"folder", run.folder().string()},
            {"command", description.command},
            {"compare_command", description.compare_command},
            {"axes", description.axes},
            {"size", outcome.done + outcome.failed + outcome.planned},
            {"done", outcome.done},
            {"failed", outcome.failed},
            {"planned", outcome.planned}};
}

/// Descriptions of the metric columns.
store::Json metric_objects()
{
    store::Json objects = store::Json::array();
    for (const analysis::MetricDescription& metric : analysis::metric_descriptions()) {
        const bool is_rate = metric.type == analysis::MetricType::number && metric.unit.empty();
        objects.push_back({{"name", metric.name},
                           {"title", metric.title},
                           {"is_rate", is_rate},
                           {"is_outcome", metric.is_outcome}});
    }
    return objects;
}

/// @throws scene::InputError  if nothing was measured.
void require_measured(const store::RunReader& run, const RunOverview& overview)
{
    if (!overview.headline) {
        throw scene::InputError(fmt::format("--against: nothing was measured in {}",
                                            scene::one_line(run.folder().string())));
    }
}

/// An earlier run to compare with.
struct EarlierRun {
    /// @throws scene::InputError  if nothing was measured in one of the runs.
    EarlierRun(const std::filesystem::path& folder, const store::RunReader& now,
               const RunOverview& overview_now)
        : run{folder, store::RunStore::Access::read_older},
          overview{read_overview(run)}
    {
        require_measured(run, overview);
        require_measured(now, overview_now);
    }

    store::RunReader run;
    RunOverview overview;
};

/// The headline's layers of an earlier run; null if they were not kept, or are damaged.
store::Json earlier_image(const EarlierRun& earlier, PackedBlocks& blocks)
{
    const auto kept = kept_images(earlier.run, earlier.overview, {});
    if (kept.empty() || kept.front().row != earlier.overview.headline->row) {
        return nullptr;
    }
    try {
        return PageImages{earlier.run.folder(), blocks}.read(kept.front());
    } catch (const scene::InputError&) {
        return nullptr;
    }
}

store::Json page_data(const store::RunReader& run, const RunOverview& overview,
                      const std::vector<KeptImage>& kept, const ReportOptions& options,
                      PackedBlocks& blocks, ReportOutcome& outcome)
{
    PageTable table = read_table(run, blocks);
    const std::vector<std::string> curves = curve_ids(run);
    store::Json data{{"schema", 1},
                     {"gnomon", run.description().environment.gnomon},
                     {"run", run_object(run)},
                     {"headline", overview.headline ? store::Json(overview.headline->row)
                                                    : store::Json(nullptr)},
                     {"table", std::move(table.columns)},
                     {"constants", std::move(table.constants)},
                     {"metrics", metric_objects()}};
    data["curves"] = read_curves(run, curves, blocks);
    data["error_vs_z"] = read_error_vs_z(run, curves, blocks);
    data["images"] = read_images(run, kept, options, blocks, outcome);
    return data;
}

PageParts page_parts(const store::RunReader& run, const RunOverview& overview,
                     const std::optional<EarlierRun>& earlier, const ReportOptions& options)
{
    PageParts parts{headline_pictures(run, overview, options.out), {}, {}};
    for (const ReportFigure& figure : options.figures) {
        parts.figures.push_back(data_address(options.out / "figures" / figure.png));
    }
    if (earlier) {
        parts.against =
            against_section({earlier->run, earlier->overview}, {run, overview}, options.out);
    }
    return parts;
}

} // namespace

void write_report_csv(const std::filesystem::path& folder, const std::filesystem::path& out)
{
    const store::RunReader run{folder, store::RunStore::Access::read_older};
    const store::sqlite::Database database{store::results_path(folder),
                                           store::sqlite::Database::Access::read};
    store::prepare_reading(database);
    store::write_run_csv(database, out);
}

ReportOutcome write_report(const ReportOptions& options)
{
    const store::RunReader run{options.folder, store::RunStore::Access::read_older};
    const RunOverview overview = read_overview(run);
    const std::vector<KeptImage> kept = kept_images(run, overview, options);
    require_kept(kept, options);
    std::optional<EarlierRun> earlier;
    if (!options.against.empty()) {
        std::error_code none;
        if (std::filesystem::equivalent(options.against, options.folder, none)) {
            throw scene::InputError("--against: this is the run itself; name an earlier run");
        }
        earlier.emplace(options.against, run, overview);
    }
    const PageParts parts = page_parts(run, overview, earlier, options);
    ReportOutcome outcome;
    outcome.schema = store::schema_text(run.schema());
    PackedBlocks blocks;
    store::Json data = page_data(run, overview, kept, options, blocks, outcome);
    if (earlier) {
        data["against"] = earlier_image(*earlier, blocks);
    }
    const std::string title = fmt::format(
        "Shadow-map accuracy: {}", overview.scene.empty() ? "several scenes" : overview.scene);
    store::write_file(
        options.out / "report.html",
        whole_page(title, page_body(run, overview, options, parts), data, blocks.texts()));
    store::write_file(options.out / "summary.md",
                      summary_text(run, overview, options, parts.headline));
    return outcome;
}

} // namespace gnomon::reports
