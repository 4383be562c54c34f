#include "methods/key_table.hpp"
#include "reports/json/comparison_json.hpp"
#include "store/csv/csv_text.hpp"
#include "store/csv/run_csv.hpp"
#include "store/run/run_store.hpp"

#include "csv_table.hpp"
#include "example_comparison.hpp"
#include "example_run.hpp"
#include "lane.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace gnomon::store {
namespace {

using analysis::Comparison;
using analysis::FinishedCurve;
using nlohmann::json;

/// A comparison whose numbers all differ.
Comparison example_comparison()
{
    Comparison comparison;
    comparison.view.maps.resize(1);
    analysis::Metrics& metrics = comparison.metrics;
    metrics.pixels.total = 1001;
    metrics.pixels.by_class = {11, 12, 13, 14, 15, 403, 307};
    metrics.pixels.by_reason = {900, 5, 6, 1, 7, 3, 2};
    metrics.false_shadow = 41;
    metrics.false_lit = 43;
    metrics.false_shadow_rate = 41.0 / 403;
    metrics.false_lit_rate = 43.0 / 307;
    metrics.error_rate = 84.0 / 710;
    metrics.amounts = {45.5, 47.25, 51, 0.125};
    metrics.shadow_amount_rate = 45.5 / 403;
    metrics.light_amount_rate = 47.25 / 307;
    metrics.mean_abs_error = 1.0 / 7;

    const scene::ImageSize size{3, 1};
    scene::Image<float> critical{size, 0.1F};
    critical[1] = 0.7F;
    scene::Image<scene::PixelClass> classes{size, scene::PixelClass::lit};
    classes[1] = scene::PixelClass::blocked;
    analysis::BiasCurve curve{critical, classes};
    const auto limits = [](double allowance, float scale) {
        return analysis::BiasLimits{allowance, 3, 0.1F * scale, 0.2F * scale, 0.3F * scale};
    };
    const analysis::BestBiases best{{0.15F, 0.17F}, {5, 6}};
    const analysis::BiasBounds bounds{
        limits(0, 1), {limits(0.0001, 2), limits(0.001, 3), limits(0.01, 5)}, true};
    comparison.diagnosis = analysis::Diagnosis{
        .causes = {{}, {}, {{0, 21, 22, 23, 24}, {0, 31, 32, 33, 34, 35}}},
        .peter_panning = {analysis::Quantiles{9, 0.01F, 0.02F, 0.03F, 0.04F},
                          analysis::Quantiles{9, 1.1F, 1.2F, 1.3F, 1.4F}},
        .biases = analysis::BiasAnswers{critical, std::move(curve), best, bounds, {}, {}, 0},
        .by_distance = {},
        .by_angle = {},
        .by_object = {}};
    analysis::CurveResult& found = comparison.diagnosis->curve;
    found.best = best;
    found.bounds = bounds;
    const analysis::Outcome outcome{{4, 2}, {4.5, 2.25, 0, 0}, 1.75};
    found.recommended = analysis::Recommendation{
        {0.5F, 2, 7}, {0.25F, 1, 3}, {0.75F, 3, 11}, outcome, {}, {}, {}, 4};
    return comparison;
}

/// The comparison as the only row of a sweep.
FinishedCurve as_curve(const Comparison& comparison, const std::string& id)
{
    FinishedCurve finished;
    finished.curve.id = id;
    analysis::ConfigurationResult result{comparison.metrics, std::nullopt, {}};
    if (comparison.diagnosis) {
        result.causes = comparison.diagnosis->causes.counts;
        result.peter_panning = comparison.diagnosis->peter_panning;
        finished.curve = comparison.diagnosis->curve;
        finished.curve.id = id;
    }
    finished.rows.push_back({0, result});
    return finished;
}

std::map<std::string, std::string> row_of(const Comparison& comparison)
{
    const TemporaryFolder folder;
    const ExampleRun example{1, 1};
    RunStore store{folder.path(), RunStore::Access::write};
    const auto configurations = example.configurations();
    store.plan(example.description(), configurations);
    store.record(as_curve(comparison, configurations[0].curve));
    store.write_csv();
    return read_csv(folder / "results.csv").rows.at(0);
}

/// The member that a column is named after.
json member(const json& object, const std::string& column)
{
    json found = object;
    std::string path = column;
    while (!path.empty() && !found.is_null()) {
        const std::string name = path.substr(0, path.find('.'));
        path.erase(0, std::min(name.size() + 1, path.size()));
        if (found.is_array()) {
            found = found.at(name == "lo" ? 0 : name == "hi" ? 1 : std::stoul(name));
        } else {
            found = found.at(name);
        }
    }
    return found;
}

/// Columns of the sweep that a comparison lacks.
bool is_of_the_sweep(const std::string& column)
{
    const std::vector<std::string> own{"schema",     "ordinal",   "id",        "curve",
                                       "case",       "status",    "message",   "scene_hash",
                                       "map_near_m", "map_far_m", "map_bytes", "bias_source"};
    return std::find(own.begin(), own.end(), column) != own.end() ||
           methods::key_table()->find(column) != nullptr;
}

/// Fails unless every cell holds what `compare --json` prints.
void expect_as_in_json(const Comparison& comparison)
{
    const json object = json::parse(reports::comparison_json(comparison));
    std::size_t compared = 0;
    for (const auto& [column, cell] : row_of(comparison)) {
        if (is_of_the_sweep(column)) {
            continue;
        }
        const json value = member(object, column);
        ++compared;
        if (value.is_null()) {
            EXPECT_EQ(cell, "") << column;
        } else if (value.is_number()) {
            EXPECT_EQ(std::stod(cell), value.get<double>()) << column;
        } else {
            EXPECT_EQ(cell, value.dump()) << column;
        }
    }
    EXPECT_EQ(compared, 8 + 6 + 12 + 11 + 14 + 7 + 7 + 18U + 13);
}

TEST(ResultsCsv, HoldsWhatCompareJsonPrints)
{
    expect_as_in_json(example_comparison());
}

TEST(ResultsCsv, LeavesEmptyWhatIsNullInJson)
{
    Comparison comparison = example_comparison();
    comparison.metrics.false_lit_rate.reset();
    comparison.diagnosis->peter_panning = {};
    constexpr float infinity = std::numeric_limits<float>::infinity();
    analysis::CurveResult& curve = comparison.diagnosis->curve;
    curve.bounds->strict.acne_free = infinity;
    curve.bounds->strict.panning_free = -infinity;
    curve.best->interval = {-infinity, infinity};
    curve.recommended->high = {infinity, infinity, infinity};
    expect_as_in_json(comparison);
    curve.recommended.reset(); // no scored pixel is lit
    expect_as_in_json(comparison);
    comparison.diagnosis->biases.reset();
    curve = {};
    expect_as_in_json(comparison);
    comparison.diagnosis.reset();
    expect_as_in_json(comparison);
}

TEST(ResultsCsv, HoldsTheJobAsItsFileWouldButWithoutQuotes)
{
    const TemporaryFolder folder;
    const ExampleRun example{1, 2};
    example.compute(folder.path());
    const auto row = read_csv(folder / "results.csv").rows.at(1);
    EXPECT_EQ(row.at("schema"), "2");
    EXPECT_EQ(row.at("ordinal"), "1");
    EXPECT_EQ(row.at("case"), "noon");
    EXPECT_EQ(row.at("status"), "done");
    EXPECT_EQ(row.at("scene_hash"), "0123456789abcdef");
    EXPECT_EQ(row.at("scene.builtin"), "wall");
    EXPECT_EQ(row.at("scene.file"), "");
    EXPECT_EQ(row.at("scene.ground"), "false");
    EXPECT_EQ(row.at("scene.no_cast"), "[]");
    EXPECT_EQ(row.at("scene.wall.width_m"), "4");
    EXPECT_EQ(row.at("camera.up"), "[0, 1, 0]");
    EXPECT_EQ(row.at("shadow_map.resolution"), "256");
    EXPECT_EQ(row.at("shadow_map.near"), "auto");
    EXPECT_EQ(std::stof(row.at("bias.constant")), 1.01e-6F);
    EXPECT_EQ(row.at("map_near_m"), "0.1");
    EXPECT_EQ(row.at("map_far_m"), "10.333333333333334");
    EXPECT_EQ(row.at("map_bytes"), "4194304");
}

TEST(ResultsCsv, HasEveryJobKeyInItsOrder)
{
    const TemporaryFolder folder;
    ExampleRun{1, 1}.compute(folder.path());
    const auto columns = read_csv(folder / "results.csv").columns;
    auto column = std::find(columns.begin(), columns.end(), "scene.builtin");
    for (const scene::Key& key : methods::key_table()->rows()) {
        ASSERT_NE(column, columns.end());
        EXPECT_EQ(*column++, key.name);
    }
    EXPECT_EQ(*column, "map_near_m");
}

TEST(ResultsCsv, KeepsHostileTextsInTheirCells)
{
    const TemporaryFolder folder;
    const ExampleRun example{1, 1};
    auto configurations = example.configurations();
    configurations[0].case_name = "=cmd|'/c calc'!A0,\"\n";
    configurations[0].parameters = {
        {"scene.file", R"("a\"b,\u000A\u0001c.obj")"},
        {"scene.no_cast", R"(["x\"y", "-1"])"},
    };
    RunStore store{folder.path(), RunStore::Access::write};
    store.plan(example.description(), configurations);
    store.record_failure(std::vector<std::uint64_t>{0}, "@file.obj:\n\"bad\", and more");
    store.write_csv();
    const CsvTable table = read_csv(folder / "results.csv");
    ASSERT_EQ(table.rows.size(), 1U);
    const auto& row = table.rows[0];
    EXPECT_EQ(row.at("case"), "'=cmd|'/c calc'!A0,\"\n");
    EXPECT_EQ(row.at("scene.file"), "a\"b,\n\uFFFDc.obj");
    EXPECT_EQ(row.at("scene.no_cast"), R"(["x\"y", "-1"])");
    EXPECT_EQ(row.at("status"), "failed");
    EXPECT_EQ(row.at("message"), "'@file.obj:?\"bad\", and more");
    EXPECT_EQ(row.at("pixels.total"), "");
    EXPECT_EQ(row.at("map_near_m"), "");
}

TEST(ResultsCsv, IsWholeThoughTheFileBesideItCannotBeWritten)
{
    const TemporaryFolder folder;
    const ExampleRun example{10, tests::in_lane(200U, 1000U)};
    example.compute(folder.path());
    const std::string whole = read_text(folder / "results.csv");
    std::filesystem::remove(folder / "error_vs_z.csv");
    std::filesystem::create_directory(folder / "error_vs_z.csv");
    const RunStore store{folder.path(), RunStore::Access::write};
    EXPECT_THROW(store.write_csv(), scene::EnvironmentError);
    EXPECT_TRUE(read_text(folder / "results.csv") == whole);
}

TEST(ErrorVsZCsv, HasABlockACurveWithTheJobsBiasFirst)
{
    const TemporaryFolder folder;
    const ExampleRun example{2, 3};
    example.compute(folder.path());
    const CsvTable table = read_csv(folder / "error_vs_z.csv");
    ASSERT_EQ(table.rows.size(), 2 * 2 * 32U);
    const auto& row = table.rows.at(64 + 32 + 2);
    EXPECT_EQ(row.at("curve"), example.configurations()[3].curve);
    EXPECT_EQ(table.rows.at(64).at("at"), "job_bias");
    EXPECT_EQ(row.at("at"), "best_bias");
    EXPECT_EQ(std::stod(row.at("bias")), double{0.0015F});
    EXPECT_EQ(std::stod(row.at("lower_m")), 2.0 / 3);
    EXPECT_EQ(row.at("lit"), "2000");
    EXPECT_EQ(row.at("blocked"), "77");
    EXPECT_EQ(std::stod(row.at("false_shadow_rate")), 20.0 / 2000);
    EXPECT_EQ(std::stod(row.at("false_lit_rate")), 2.0 / 77);
    EXPECT_EQ(std::stod(row.at("error_rate")), 22.0 / 2077);
    EXPECT_EQ(row.at("needed_bias.count"), "12");
    EXPECT_EQ(std::stof(row.at("needed_bias.max")), 1.1F * 1e-4F);
    EXPECT_EQ(row.at("map_error_m.median"), "");
    EXPECT_EQ(table.rows.at(0).at("false_shadow_rate"), ""); // no lit pixel in that bin
}

TEST(BiasCurvesCsv, HasThePointsOfEachCurveInOrder)
{
    const TemporaryFolder folder;
    const ExampleRun example{2, 3};
    example.compute(folder.path());
    const CsvTable table = read_csv(folder / "bias_curves.csv");
    ASSERT_EQ(table.rows.size(), 200U);
    const analysis::CurveSample point = example.curve(1).curve.points[4];
    const auto& row = table.rows.at(104);
    EXPECT_EQ(row.at("curve"), example.configurations()[3].curve);
    EXPECT_EQ(std::stod(row.at("bias")), double{point.bias});
    EXPECT_EQ(row.at("false_shadow"), "960");
    EXPECT_EQ(row.at("false_lit"), "5");
    EXPECT_EQ(std::stod(row.at("false_shadow_rate")), 960.0 / 380'000);
    EXPECT_EQ(std::stod(row.at("false_lit_rate")), 5.0 / 158'000);
    EXPECT_EQ(std::stod(row.at("error_rate")), 965.0 / 538'000);
    EXPECT_EQ(std::stod(row.at("shadow_amount")), 960.25);
    EXPECT_EQ(std::stod(row.at("light_amount")), 5.0 / 3);
    EXPECT_EQ(std::stod(row.at("mean_abs_error")), (960.25 + 5.0 / 3) / 538'000);
}

TEST(ByMapCsv, HasARowForEachConfigurationAndMap)
{
    const TemporaryFolder folder;
    const ExampleRun example{2, 3, 1, 4};
    example.compute(folder.path());
    const CsvTable table = read_csv(folder / "by_map.csv");
    ASSERT_EQ(table.rows.size(), 2 * 3 * 4U);
    const auto& row = table.rows.at(4 * 4 + 2);
    const analysis::MapResult map = example.curve(1).rows.at(1).result.by_map.at(2);
    EXPECT_EQ(row.at("id"), example.configurations()[4].id);
    EXPECT_EQ(row.at("curve"), example.configurations()[4].curve);
    EXPECT_EQ(row.at("map_index"), "2");
    EXPECT_EQ(row.at("map"), "2");
    EXPECT_EQ(std::stod(row.at("near_m")), map.facts.near_m);
    EXPECT_EQ(std::stod(row.at("far_m")), map.facts.far_m);
    EXPECT_EQ(std::stod(row.at("texel_m")), map.facts.texel_m);
    EXPECT_EQ(std::stod(row.at("begin_m")), map.facts.begin_m);
    EXPECT_EQ(std::stod(row.at("end_m")), map.facts.end_m);
    EXPECT_EQ(std::stod(row.at("bias_m")), map.facts.bias->constant_m);
    EXPECT_EQ(row.at("lit"), "1002");
    EXPECT_EQ(row.at("blocked"), "500");
    EXPECT_EQ(row.at("false_shadow"), "14");
    EXPECT_EQ(row.at("false_lit"), "2");
    EXPECT_EQ(std::stod(row.at("shadow_amount")), 12.25);
    EXPECT_EQ(std::stod(row.at("light_amount")), 2.0 / 3);
    EXPECT_EQ(row.at("causes.bias"), "1");
    EXPECT_EQ(row.at("causes.resolution"), "11");
}

TEST(ByMapCsv, LeavesCellsEmptyWithoutCascades)
{
    const TemporaryFolder folder;
    const ExampleRun example{1, 1};
    std::filesystem::create_directories(folder.path());
    RunStore store{folder.path(), RunStore::Access::write};
    store.plan(example.description(), example.configurations());
    FinishedCurve curve = example.curve(0);
    curve.rows[0].result.by_map.resize(6);
    curve.rows[0].result.by_map[0].facts.name = "+x";
    store.record(curve);
    store.write_csv();
    const CsvTable table = read_csv(folder / "by_map.csv");
    ASSERT_EQ(table.rows.size(), 6U);
    EXPECT_EQ(table.rows[0].at("map"), "'+x"); // no formula
    for (const char* const column : {"begin_m", "end_m", "bias_m"}) {
        EXPECT_EQ(table.rows[0].at(column), "");
    }
}

TEST(ByMapCsv, IsNotThereWhereNoLightHasSeveralMaps)
{
    const TemporaryFolder folder;
    ExampleRun{2, 3}.compute(folder.path());
    EXPECT_FALSE(exists(folder / "by_map.csv"));
}

TEST(ByMapCsv, ChangesNoOtherFile)
{
    const TemporaryFolder folder;
    ExampleRun{2, 3}.compute(folder / "one");
    ExampleRun{2, 3, 1, 4}.compute(folder / "several");
    EXPECT_EQ(csv_texts(folder / "several"), csv_texts(folder / "one"));
}

TEST(ByMapCsv, IsOfTheLastResultsOfAConfiguration)
{
    const TemporaryFolder folder;
    const ExampleRun example{1, 2, 1, 3};
    example.compute(folder.path());
    const std::string first = read_text(folder / "by_map.csv");
    RunStore store{folder.path(), RunStore::Access::write};
    FinishedCurve curve = example.curve(0);
    curve.rows[1].result.by_map[0].errors.counts.false_lit = 77;
    store.record(curve);
    store.write_csv();
    EXPECT_EQ(read_csv(folder / "by_map.csv").rows.at(3).at("false_lit"), "77");
    store.record(example.curve(0));
    store.write_csv();
    EXPECT_EQ(read_text(folder / "by_map.csv"), first);
}

/// A run of an older Gnomon without errors by map.
void forget_map_errors(const std::filesystem::path& run)
{
    sqlite::Database{run / "results.sqlite", sqlite::Database::Access::write}.run(
        "DROP TABLE map_errors");
}

TEST(ByMapCsv, IsOfWhatAnOlderRunGetsAnew)
{
    const TemporaryFolder folder;
    const ExampleRun example{2, 2, 1, 3};
    {
        std::filesystem::create_directories(folder.path());
        RunStore store{folder.path(), RunStore::Access::write};
        store.plan(example.description(), example.configurations());
        example.record(store, 1, {1});
    }
    forget_map_errors(folder.path());
    EXPECT_EQ(RunStore(folder.path(), RunStore::Access::read).description().size, 4U);
    RunStore store{folder.path(), RunStore::Access::write};
    store.write_csv();
    EXPECT_FALSE(exists(folder / "by_map.csv"));
    store.record(example.curve(1));
    store.write_csv();
    const CsvTable table = read_csv(folder / "by_map.csv");
    ASSERT_EQ(table.rows.size(), 2 * 3U);
    EXPECT_EQ(table.rows[0].at("id"), example.configurations()[2].id);
}

TEST(RunCsv, IsTheSameEveryTime)
{
    const TemporaryFolder folder;
    const ExampleRun example{4, 5};
    example.compute(folder / "a");
    const std::string first = csv_texts(folder / "a");
    RunStore{folder / "a", RunStore::Access::write}.write_csv();
    EXPECT_EQ(csv_texts(folder / "a"), first);
    example.compute(folder / "b");
    EXPECT_EQ(csv_texts(folder / "b"), first);
}

TEST(RunCsv, DoesNotDependOnTheOrderOfTheResults)
{
    const TemporaryFolder folder;
    const ExampleRun example{4, 5};
    example.compute(folder / "a");
    std::filesystem::create_directory(folder / "b");
    RunStore store{folder / "b", RunStore::Access::write};
    store.plan(example.description(), example.configurations());
    for (const std::uint64_t curve : {3U, 1U, 0U, 2U}) {
        analysis::FinishedCurve finished = example.curve(curve);
        std::reverse(finished.rows.begin(), finished.rows.end());
        store.record(finished);
    }
    store.write_csv();
    EXPECT_EQ(csv_texts(folder / "b"), csv_texts(folder / "a"));
}

TEST(RunCsv, HoldsWhatTheViewSelectsForCurvesThatAreDoneInPart)
{
    const TemporaryFolder folder;
    const ExampleRun example{3, 4};
    RunStore store{folder.path(), RunStore::Access::write};
    store.plan(example.description(), example.configurations());
    store.record(example.curve(0));
    FinishedCurve partly = example.curve(1);
    const std::uint64_t failed = partly.rows.back().ordinal;
    partly.rows.resize(2);
    store.record(partly);
    store.record_failure({&failed, 1}, "it, too, failed", analysis::Retry::may_help);
    store.write_csv();
    const CsvTable results = read_csv(folder / "results.csv");
    const sqlite::Database database{folder / "results.sqlite", sqlite::Database::Access::read};
    sqlite::Statement rows{database, "SELECT * FROM results ORDER BY ordinal"};
    std::set<std::string> statuses;
    for (const auto& row : results.rows) {
        ASSERT_TRUE(rows.step());
        for (int i = 0; i < rows.column_count(); ++i) {
            EXPECT_EQ(row.at(rows.column_name(i)), cell_text(rows.value(i)))
                << rows.column_name(i) << " of ordinal " << row.at("ordinal");
        }
        statuses.insert(row.at("status"));
    }
    EXPECT_FALSE(rows.step());
    EXPECT_EQ(statuses.size(), 3U);
}

TEST(RunCsv, HasARowForWhatIsMissing)
{
    const TemporaryFolder folder;
    const ExampleRun example{2, 2};
    RunStore store{folder.path(), RunStore::Access::write};
    store.plan(example.description(), example.configurations());
    store.record(example.curve(1));
    store.write_csv();
    const CsvTable results = read_csv(folder / "results.csv");
    ASSERT_EQ(results.rows.size(), 4U);
    EXPECT_EQ(results.rows[0].at("status"), "planned");
    EXPECT_EQ(results.rows[0].at("false_shadow"), "");
    EXPECT_EQ(results.rows[0].at("scene.builtin"), "wall");
    EXPECT_EQ(results.rows[2].at("status"), "done");
    EXPECT_EQ(read_csv(folder / "bias_curves.csv").rows.size(), 100U);
}

} // namespace
} // namespace gnomon::store
