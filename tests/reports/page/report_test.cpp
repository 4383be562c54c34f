#include "reports/page/report.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "reports/json/comparison_json.hpp"
#include "reports/page/page_html.hpp"
#include "scene/error.hpp"
#include "scene/infinity.hpp"
#include "store/exr/aov.hpp"
#include "store/images/layer_file.hpp"
#include "store/output_file.hpp"
#include "store/run/run_store.hpp"
#include "store/run_folder/pixels.hpp"

#include "csv_table.hpp"
#include "example_comparison.hpp"
#include "example_page.hpp"
#include "example_run.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The table's rows as CSV lines.
std::vector<std::map<std::string, std::string>> table_rows(const ReadPage& page)
{
    const auto& data = page.data();
    std::vector<std::map<std::string, std::string>> rows(
        data.at("table").at("count").get<std::size_t>());
    for (const auto& column : data.at("table").at("columns")) {
        const std::vector<std::string> texts = page.texts(column);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i][column.at("name")] = texts[i];
        }
    }
    for (const auto& [name, value] : data.at("constants").items()) {
        for (auto& row : rows) {
            row[name] = value;
        }
    }
    return rows;
}

TEST(Report, HoldsEveryNumberOfTheResults)
{
    const store::TemporaryFolder folder;
    store::ExampleRun{}.compute(folder / "run");
    const ReadPage page = written_page(folder / "run", folder / "out");
    const store::CsvTable csv = store::read_csv(folder / "out/results.csv");
    EXPECT_EQ(store::read_text(folder / "out/results.csv"),
              store::read_text(folder / "run/results.csv"));
    const auto rows = table_rows(page);
    ASSERT_EQ(rows.size(), 12U);
    ASSERT_EQ(rows.size(), csv.rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const auto& [name, value] : csv.rows[i]) {
            const auto cell = rows[i].find(name);
            EXPECT_EQ(cell == rows[i].end() ? "" : cell->second, value) << name << ", row " << i;
        }
    }
}

TEST(Report, HoldsEveryPointOfTheCurves)
{
    const store::TemporaryFolder folder;
    store::ExampleRun{}.compute(folder / "run");
    const ReadPage page = written_page(folder / "run", folder / "out");
    const auto& curves = page.data().at("curves");
    const store::CsvTable csv = store::read_csv(folder / "out/bias_curves.csv");
    const auto ids = page.texts(curves.at("columns").at(0));
    const auto first = page.bits(curves.at("columns").at(1));
    const auto counts = page.bits(curves.at("columns").at(2));
    const auto biases = page.floats(curves.at("points").at("columns").at(0));
    const auto false_shadow = page.bits(curves.at("points").at("columns").at(1));
    const auto false_lit = page.bits(curves.at("points").at("columns").at(2));
    ASSERT_EQ(biases.size(), csv.rows.size());
    std::size_t i = 0;
    for (std::size_t c = 0; c < ids.size(); ++c) {
        ASSERT_EQ(first[c], i);
        for (std::uint64_t k = 0; k < counts[c]; ++k, ++i) {
            EXPECT_EQ(csv.rows[i].at("curve"), ids[c]);
            EXPECT_EQ(std::stod(csv.rows[i].at("bias")), double{biases[i]});
            EXPECT_EQ(csv.rows[i].at("false_shadow"), std::to_string(false_shadow[i]));
            EXPECT_EQ(csv.rows[i].at("false_lit"), std::to_string(false_lit[i]));
        }
    }
    EXPECT_EQ(i, csv.rows.size());
    EXPECT_EQ(curves.at("thinned"), false);
    const auto& bins = page.data().at("error_vs_z");
    const store::CsvTable bins_csv = store::read_csv(folder / "out/error_vs_z.csv");
    ASSERT_EQ(bins.at("count"), bins_csv.rows.size());
    for (const auto& column : bins.at("columns")) {
        if (column.at("name") != "curve") {
            const auto texts = page.texts(column);
            for (std::size_t row = 0; row < texts.size(); ++row) {
                EXPECT_EQ(texts[row], bins_csv.rows[row].at(column.at("name")));
            }
        }
    }
}

TEST(Report, NamesTheBestConfigurationAndItsCommand)
{
    const store::TemporaryFolder folder;
    store::ExampleRun run;
    store::RunDescription description = run.description();
    description.compare_command = "gnomon compare job.toml";
    std::filesystem::create_directories(folder / "run");
    store::RunStore store{folder / "run", store::RunStore::Access::write};
    store.plan(description, run.configurations());
    run.record(store);
    const ReadPage page = written_page(folder / "run", folder / "out");
    // Errors grow with the ordinal: 1000 + ordinal, and ordinal modulo 13.
    EXPECT_EQ(page.data().at("headline"), 0);
    EXPECT_THAT(page.html(), HasSubstr("The best has 0.186 % of the scored pixels wrong: 1,000 "
                                       "false shadow, 0 false lit"));
    EXPECT_THAT(page.html(), HasSubstr("gnomon compare job.toml --case noon --set "
                                       "shadow_map.resolution=256 --set bias.constant="));
    const std::string summary = store::read_text(folder / "out/summary.md");
    EXPECT_THAT(summary, HasSubstr("12 of 12 configurations measured."));
    EXPECT_THAT(summary, HasSubstr("| 1,000 | 0.263 % | 0 | 0 % | 0.186 % |"));
    EXPECT_LT(summary.size(), 65'536U); // the longest text that GitHub accepts
}

/// The example with its first false-shadow pixel right, and its first right lit pixel dark.
analysis::Comparison with_two_changes()
{
    analysis::Comparison comparison = store::example().comparison;
    const auto change = [&](bool was_wrong, float verdict) {
        for (std::size_t i = 0; i < comparison.truth.pixel_class.pixel_count(); ++i) {
            float& own = comparison.lookup.samples[i].verdict;
            const bool is_lit = scene::is_lit(comparison.truth.pixel_class[i]);
            if (is_lit && (own < 0.5F) == was_wrong && own != verdict) {
                own = verdict;
                return;
            }
        }
    };
    change(true, 1);
    change(false, 0);
    return comparison;
}

TEST(Report, CountsThePixelsThatChangedAgainstAnEarlierRun)
{
    const store::TemporaryFolder folder;
    keep_example(folder / "before");
    keep_example(folder / "now", with_two_changes());
    std::filesystem::create_directories(folder / "out");
    ReportOptions options{folder / "now", folder / "out"};
    options.against = folder / "before";
    (void)write_report(options);
    const std::string page = store::read_text(folder / "out/report.html");
    EXPECT_THAT(page, HasSubstr("1 pixel became wrong, and 1 right."));
    EXPECT_THAT(page, HasSubstr("no key differs"));
    EXPECT_THAT(page, Not(HasSubstr("The truth itself differs")));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/pictures/changed.png"));
}

TEST(Report, SaysWhyPixelsCannotBeCompared)
{
    const store::TemporaryFolder folder;
    store::ExampleRun{}.compute(folder / "before"); // keeps no pixels
    keep_example(folder / "now");
    std::filesystem::create_directories(folder / "out");
    ReportOptions options{folder / "now", folder / "out"};
    options.against = folder / "before";
    (void)write_report(options);
    EXPECT_THAT(store::read_text(folder / "out/report.html"),
                HasSubstr("a run did not keep those of its headline"));
}

TEST(Report, ShowsTheNotesOnTheScenes)
{
    const store::TemporaryFolder folder;
    const store::ExampleRun run;
    store::RunDescription description = run.description();
    description.notes = {{"a.glb", {"alpha_mask", 1, hostile_text}, description.size},
                         {"b.glb", {"alpha_blend", 2, "2 materials are transparent"}, 4}};
    std::filesystem::create_directories(folder / "run");
    store::RunStore store{folder / "run", store::RunStore::Access::write};
    store.plan(description, run.configurations());
    run.record(store);
    const ReadPage page = written_page(folder / "run", folder / "out");
    EXPECT_THAT(page.html(), HasSubstr("<li><bdi>a.glb: " + escaped(hostile_text) + "</bdi></li>"));
    EXPECT_THAT(page.html(), HasSubstr("<li><bdi>b.glb: 2 materials are transparent (in 4 of 12 "
                                       "configurations)</bdi></li>"));
    EXPECT_THAT(store::read_text(folder / "out/summary.md"),
                HasSubstr("\n- note: b.glb: 2 materials are transparent (in 4 of 12"));
}

TEST(Report, OfARunThatFailedSaysSo)
{
    const store::TemporaryFolder folder;
    const store::ExampleRun run;
    std::filesystem::create_directories(folder / "run");
    store::RunStore store{folder / "run", store::RunStore::Access::write};
    store.plan(run.description(), run.configurations());
    store.record_failure(std::vector<std::uint64_t>{0, 1}, hostile_text);
    const ReadPage page = written_page(folder / "run", folder / "out");
    EXPECT_TRUE(page.data().at("headline").is_null());
    EXPECT_THAT(page.html(),
                HasSubstr("0 of 12 configurations measured, 2 failed, 10 not computed yet."));
    EXPECT_THAT(page.html(), HasSubstr("python3-matplotlib is missing"));
    EXPECT_THAT(page.html(), HasSubstr("<bdi>" + escaped(hostile_text) + "</bdi>"));
    EXPECT_THAT(store::read_text(folder / "out/summary.md"),
                HasSubstr("- failed: case = noon, shadow\\_map.resolution = 256, "));
    EXPECT_THAT(page.html(), Not(HasSubstr("<img")));
    EXPECT_EQ(table_rows(page).at(0).at("message"), hostile_text);
}

TEST(Report, HoldsTheLayersOfAKeptImageBitByBit)
{
    const store::TemporaryFolder folder;
    keep_example(folder / "run");
    const ReadPage page = written_page(folder / "run", folder / "out");
    ASSERT_EQ(page.data().at("images").size(), 1U);
    const auto& image = page.data().at("images").at(0);
    EXPECT_EQ(image.at("width"), 96);
    EXPECT_EQ(image.at("height"), 64);
    EXPECT_EQ(image.at("row"), 0);
    const auto& layers = image.at("layers");
    const analysis::Comparison& comparison = store::example().comparison;
    const auto classes = page.bits(layers.at("class"));
    const auto prims = page.bits(layers.at("prim"));
    const auto depths = page.bits(layers.at("map_depth"));
    const auto verdicts = page.floats(layers.at("verdict"));
    for (std::size_t i = 0; i < classes.size(); ++i) {
        ASSERT_EQ(classes[i], static_cast<std::uint64_t>(comparison.truth.pixel_class[i]));
        ASSERT_EQ(prims[i], comparison.receivers.triangle[i]);
        ASSERT_EQ(depths[i], std::bit_cast<std::uint32_t>(comparison.lookup.samples[i].map_depth));
        ASSERT_EQ(verdicts[i], comparison.lookup.samples[i].verdict);
    }
    EXPECT_EQ(image.at("frustum").at("near_m"), comparison.view.first_map().near_m);
}

/// The example with an arbitrary critical bias for each pixel.
analysis::Comparison with_critical_biases()
{
    analysis::Comparison comparison = store::example().comparison;
    const auto& classes = comparison.truth.pixel_class;
    scene::Image<float> criticals{classes.size()};
    for (std::size_t i = 0; i < criticals.pixel_count(); ++i) {
        const float r = comparison.lookup.samples[i].receiver_depth;
        const float d = comparison.lookup.samples[i].map_depth;
        constexpr std::array<float, 3> unlike{scene::infinity, -scene::infinity, 0.25F};
        criticals[i] = i % 7 < unlike.size() ? unlike.at(i % 7) : analysis::next_bias(r - d);
    }
    const scene::Image<float> zeros{classes.size()};
    analysis::BiasCurve curve{criticals, classes};
    comparison.diagnosis = analysis::Diagnosis{
        .light_distance_m = zeros,
        .map_error_m = zeros,
        .causes = {scene::Image<analysis::Cause>{classes.size()},
                   scene::Image<analysis::Label>{classes.size()},
                   {}},
        .peter_panning = {},
        .biases = analysis::BiasAnswers{
            criticals, std::move(curve), {}, {}, {zeros, zeros, zeros, zeros}, {}, 0}};
    return comparison;
}

/// The example as if its light had two cascades, the pixels of its left half in the first.
analysis::Comparison with_two_cascades()
{
    analysis::Comparison comparison = with_critical_biases();
    scene::View& view = comparison.view;
    view.maps.push_back(view.first_map());
    view.slices.begin = 1;
    view.slices.ends = {4.5F, 20};
    view.bias.constant = 0.25F;
    const scene::ImageSize size = comparison.truth.pixel_class.size();
    comparison.lookup.maps = scene::MapIndices{size};
    for (std::size_t i = 0; i < comparison.lookup.maps.pixel_count(); ++i) {
        const bool is_left = i % static_cast<std::size_t>(size.width_px) < 48;
        comparison.lookup.maps[i] = is_left ? 0 : 1;
    }
    comparison.diagnosis->by_map = {{{100, 20, 7, 3, 7, 3}, {}}, {{50, 10, 5, 1, 5, 1}, {}}};
    return comparison;
}

TEST(Report, HoldsWhichMapEachScoredPixelReads)
{
    const store::TemporaryFolder folder;
    const analysis::Comparison comparison = with_two_cascades();
    keep_example(folder / "run", comparison);
    const ReadPage page = written_page(folder / "run", folder / "out");
    const auto maps = page.bits(page.data().at("images").at(0).at("layers").at("map_index"));
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const bool is_scored = scene::is_scored(comparison.truth.pixel_class[i]);
        ASSERT_EQ(maps[i], is_scored ? comparison.lookup.maps[i] : 255U) << i;
    }
}

/// The example with texels that rise by 2/3 from pixel to pixel, but for the first ones.
analysis::Comparison with_texels(const std::vector<scene::Vec2f>& first)
{
    analysis::Comparison comparison = store::example().comparison;
    comparison.lookup.texels = scene::Image<scene::Vec2f>{comparison.truth.pixel_class.size()};
    for (std::size_t i = 0; i < comparison.lookup.texels.pixel_count(); ++i) {
        const float place = static_cast<float>(i) / 1.5F;
        comparison.lookup.texels[i] = i < first.size() ? first[i] : scene::Vec2f{place, 2 * place};
    }
    return comparison;
}

TEST(Report, HoldsTheTexelOfEachReceiver)
{
    const store::TemporaryFolder folder;
    const analysis::Comparison comparison = with_texels({});
    keep_example(folder / "run", comparison);
    const ReadPage page = written_page(folder / "run", folder / "out");
    const auto& layers = page.data().at("images").at(0).at("layers");
    const auto columns = page.bits(layers.at("texel_x"));
    const auto rows = page.bits(layers.at("texel_y"));
    ASSERT_EQ(columns.size(), comparison.lookup.texels.pixel_count());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const scene::Vec2f& texel = comparison.lookup.texels[i];
        ASSERT_EQ(columns[i], static_cast<std::uint64_t>(std::floor(texel.x))) << i;
        ASSERT_EQ(rows[i], static_cast<std::uint64_t>(std::floor(texel.y))) << i;
    }
}

TEST(Report, HoldsNoTexelBeforeTheMapOrBeyond16Bits)
{
    const store::TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    keep_example(folder / "run", with_texels({{-0.5F, 3}, {70000, nan}}));
    const ReadPage page = written_page(folder / "run", folder / "out");
    const auto& layers = page.data().at("images").at(0).at("layers");
    const auto columns = page.bits(layers.at("texel_x"));
    const auto rows = page.bits(layers.at("texel_y"));
    EXPECT_EQ(columns[0], 65535U);
    EXPECT_EQ(rows[0], 3U);
    EXPECT_EQ(columns[1], 65535U);
    EXPECT_EQ(rows[1], 65535U);
}

TEST(Report, OfAnotherRenderersMaskHoldsNoTexels)
{
    const store::TemporaryFolder folder;
    keep_example(folder / "run");
    const ReadPage page = written_page(folder / "run", folder / "out");
    EXPECT_FALSE(page.data().at("images").at(0).at("layers").contains("texel_x"));
}

TEST(Report, OfALightWithOneMapSaysNothingOfMaps)
{
    const store::TemporaryFolder folder;
    keep_example(folder / "run");
    const ReadPage page = written_page(folder / "run", folder / "out");
    EXPECT_FALSE(page.data().at("images").at(0).at("layers").contains("map_index"));
    EXPECT_THAT(page.html(), Not(HasSubstr("<caption>By map</caption>")));
}

TEST(Report, TellsWhatEachCascadeSees)
{
    const store::TemporaryFolder folder;
    keep_example(folder / "run", with_two_cascades());
    const ReadPage page = written_page(folder / "run", folder / "out");
    const double range_m = store::example().comparison.view.first_map().range_m();
    EXPECT_THAT(page.html(), HasSubstr("<caption>By map</caption>"));
    for (const char* const slice : {"1 to 4.5", "4.5 to 20"}) {
        EXPECT_THAT(page.html(), HasSubstr(fmt::format("<td class=\"number\">{}</td>", slice)));
    }
    EXPECT_THAT(page.html(),
                HasSubstr(fmt::format("<td class=\"number\">{:.4g}</td><td class=\"number\">"
                                      "{:.3g}</td><td class=\"number\">7</td>",
                                      range_m, 0.25 * range_m)));
}

TEST(Report, ThinsAnImageThatIsTooLargeForThePage)
{
    const store::TemporaryFolder folder;
    keep_example(folder / "run");
    const ReadPage whole = written_page(folder / "run", folder / "whole");
    const auto& image = whole.data().at("images").at(0);
    EXPECT_EQ(image.at("step"), 1);
    const ReadPage page = written_page(folder / "run", folder / "out", 1);
    const auto& thin = page.data().at("images").at(0);
    EXPECT_EQ(thin.at("step"), 8);
    EXPECT_EQ(thin.at("width"), 96 / 8);
    EXPECT_EQ(thin.at("height"), 64 / 8);
    EXPECT_EQ(thin.at("detail"), image.at("detail"));
    for (const auto& [name, block] : thin.at("layers").items()) {
        const auto taken = page.bits(block);
        const auto all = whole.bits(image.at("layers").at(name));
        ASSERT_EQ(taken.size(), 12U * 8U) << name;
        for (std::size_t i = 0; i < taken.size(); ++i) {
            EXPECT_EQ(taken[i], all[8 * (i / 12) * 96 + 8 * (i % 12)]) << name << ' ' << i;
        }
    }
}

TEST(Report, TellsEveryCriticalBiasByItsDistanceFromTheDepthsDifference)
{
    const store::TemporaryFolder folder;
    const analysis::Comparison comparison = with_critical_biases();
    keep_example(folder / "run", comparison);
    const ReadPage page = written_page(folder / "run", folder / "out");
    const auto& layers = page.data().at("images").at(0).at("layers");
    const auto receivers = page.floats(layers.at("receiver_depth"));
    const auto depths = page.floats(layers.at("map_depth"));
    const auto steps = page.bits(layers.at("critical_bias_steps"));
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!scene::is_scored(comparison.truth.pixel_class[i])) {
            EXPECT_EQ(steps[i], 0U) << i;
            continue;
        }
        const float difference = receivers[i] - depths[i];
        const auto start = static_cast<std::uint32_t>(
            analysis::bias_rank(std::isnormal(difference) ? difference : 0.0F));
        const auto rank = static_cast<std::uint32_t>(start + steps[i]);
        EXPECT_EQ(analysis::bias_of_rank(static_cast<std::int32_t>(rank)),
                  comparison.diagnosis->biases->critical_bias[i])
            << i;
    }
}

TEST(Report, RefusesAConfigurationWhoseLayersWereNotKept)
{
    const store::TemporaryFolder folder;
    keep_example(folder / "run");
    std::filesystem::create_directories(folder / "out");
    ReportOptions options{folder / "run", folder / "out", {}, {}, {"0123456789abcdef"}};
    try {
        write_report(options);
        FAIL() << "it was not refused";
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("--configuration 0123456789abcdef: "));
        EXPECT_THAT(error.what(), HasSubstr("--keep-pixels"));
    }
}

/// The problems that a report names; checks that the page exists nevertheless.
std::string problem_of(const std::filesystem::path& run, const std::filesystem::path& out)
{
    std::filesystem::create_directories(out);
    const ReportOutcome outcome = write_report({run, out, {}, {}, {}});
    EXPECT_EQ(ReadPage{store::read_text(out / "report.html")}.data().at("images").size(),
              outcome.images);
    EXPECT_EQ(outcome.images + outcome.problems.size(), 1U);
    return outcome.problems.empty() ? "none" : outcome.problems.front();
}

TEST(Report, LeavesDamagedLayersOutAndSaysSo)
{
    const store::TemporaryFolder folder;
    const std::filesystem::path run = folder / "run";
    keep_example(run);
    const std::string id = store::ExampleRun{1, 1}.configurations().front().id;
    EXPECT_EQ(problem_of(run, folder / "out"), "none");
    const std::string sound = store::read_text(store::detail_path(run, id));
    for (const std::string text : {"", "{", "[]", "{\"job\": 7}"}) {
        store::write_file(store::detail_path(run, id), text);
        const std::string problem = problem_of(run, folder / "out");
        EXPECT_THAT(problem, HasSubstr(id + ".json: is damaged")) << text;
        EXPECT_THAT(problem, Not(HasSubstr("\n")));
    }
    // If requested, they are an error.
    EXPECT_THROW(write_report({run, folder / "out", {}, {}, {id}}), scene::InputError);
    store::write_file(store::detail_path(run, id), sound);
    store::write_file(store::pixels_path(run, id),
                      store::read_text(store::pixels_path(run, id)).substr(0, 5000));
    EXPECT_THAT(problem_of(run, folder / "out"), HasSubstr(id + ".exr: "));
}

TEST(Report, DoesNotTakeAnotherConfigurationsLayers)
{
    const store::TemporaryFolder folder;
    const std::filesystem::path run = folder / "run";
    keep_example(run);
    const std::string id = store::ExampleRun{1, 1}.configurations().front().id;
    const store::Example other{{.bias_constant = 0.01}};
    store::write_aov(store::pixels_path(run, id), other.comparison, other.points);
    EXPECT_THAT(problem_of(run, folder / "out"), HasSubstr("or belongs to another configuration"));
    store::write_file(store::detail_path(run, id), comparison_json(other.comparison));
    EXPECT_THAT(problem_of(run, folder / "out"), HasSubstr("or belongs to another configuration"));
}

TEST(Report, RefusesARunInWhichNothingWasPlanned)
{
    const store::TemporaryFolder folder;
    {
        const store::RunStore store{folder.path(), store::RunStore::Access::write};
    }
    EXPECT_THROW(write_report_csv(folder.path(), folder.path()), scene::InputError);
}

TEST(Report, NamesThePartOfADividedSweep)
{
    const store::TemporaryFolder folder;
    store::ExampleRun run;
    run.shards = 2;
    run.compute(folder / "run", 2);
    const ReadPage page = written_page(folder / "run", folder / "out");
    EXPECT_THAT(page.html(), HasSubstr("This is part 2 of 2 of a sweep of 12 configurations"));
    EXPECT_THAT(page.html(), HasSubstr("gnomon sweep job.toml --shard 2/2 --out RUN"));
}

TEST(Report, RefusesAFolderThatIsNoRun)
{
    const store::TemporaryFolder folder;
    EXPECT_THROW(write_report({folder.path(), folder.path(), {}, {}, {}}), scene::InputError);
}

} // namespace
} // namespace gnomon::reports
