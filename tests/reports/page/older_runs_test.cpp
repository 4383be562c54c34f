// Runs of schema 1, which have no amounts, are read-only.

#include "csv_table.hpp"
#include "example_comparison.hpp"
#include "example_run.hpp"
#include "reports/page/report.hpp"
#include "reports/tables/run_status_text.hpp"
#include "scene/error.hpp"
#include "store/merge/merge.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::reports {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

using store::sqlite::Database;

/// The columns that schema 2 added, by table.
const std::vector<std::pair<std::string, std::vector<std::string>>>& added_columns()
{
    static const std::vector<std::pair<std::string, std::vector<std::string>>> added{
        {"configurations",
         {"shadow_amount",
          "light_amount",
          "shadow_amount_rate",
          "light_amount_rate",
          "partial",
          "unassigned",
          "causes.filter",
          "labels.bleed",
          "cause_amounts.bias",
          "cause_amounts.precision",
          "cause_amounts.resolution",
          "cause_amounts.coverage",
          "cause_amounts.filter",
          "label_amounts.acne",
          "label_amounts.peter_panning",
          "label_amounts.leak",
          "label_amounts.edge",
          "label_amounts.overshadow",
          "label_amounts.bleed",
          "softening",
          "shadow_softening",
          "light_softening"}},
        {"curves",
         {"bias_curve.acne_free_count", "bias_curve.allowances.0.acne_free_count",
          "bias_curve.allowances.1.acne_free_count", "bias_curve.allowances.2.acne_free_count"}},
        {"curve_points", {"shadow_amount", "light_amount"}},
        {"curve_bins", {"shadow_amount", "light_amount"}}};
    return added;
}

/// An example run in schema 1.
void make_older_run(const std::filesystem::path& folder)
{
    store::ExampleRun{2, 3}.compute(folder);
    const Database database{store::results_path(folder), Database::Access::write};
    for (const char* const view : {"part", "results", "error_vs_z", "bias_curves"}) {
        database.run(fmt::format("DROP VIEW {}", view));
    }
    for (const auto& [table, columns] : added_columns()) {
        for (const std::string& column : columns) {
            database.run(fmt::format("ALTER TABLE {} DROP COLUMN {}", table,
                                     store::sqlite::sql_name(column)));
        }
    }
    database.run("PRAGMA user_version = 1");
}

TEST(OlderRuns, SayWhatTheyLack)
{
    const store::TemporaryFolder folder;
    make_older_run(folder / "run");
    const store::RunStatus status = store::read_run_status(folder / "run", 20);
    EXPECT_EQ(status.schema.version, 1);
    for (const auto& [table, columns] : added_columns()) {
        for (const std::string& column : columns) {
            const bool was_counted = column.ends_with("acne_free_count");
            EXPECT_EQ(std::ranges::count(status.schema.lacks, column), was_counted ? 0 : 1)
                << column;
        }
    }
    EXPECT_EQ(status.done, 6U);
    EXPECT_THAT(run_status_text(status),
                AllOf(HasSubstr("this run is of schema 1: an older Gnomon wrote it, which did not "
                                "know shadow_amount, light_amount,"),
                      Not(HasSubstr("resume"))));
    const auto json = nlohmann::json::parse(run_status_json(status));
    EXPECT_EQ(json.at("run_schema"), 1);
    EXPECT_THAT(json.at("lacks").get<std::vector<std::string>>(), Contains("softening"));
}

TEST(OlderRuns, OfThePresentSchemaLackNothing)
{
    const store::TemporaryFolder folder;
    store::ExampleRun{1, 1}.compute(folder / "run");
    const store::RunStatus status = store::read_run_status(folder / "run", 20);
    EXPECT_TRUE(status.schema.lacks.empty());
    EXPECT_EQ(store::schema_text(status.schema), "");
}

TEST(OlderRuns, AreReportedWithWhatTheyHave)
{
    const store::TemporaryFolder folder;
    make_older_run(folder / "run");
    store::ExampleRun{2, 3}.compute(folder / "present");
    write_report_csv(folder / "run", folder.path());
    const store::CsvTable older = store::read_csv(folder / "results.csv");
    const store::CsvTable present = store::read_csv(folder / "present" / "results.csv");
    ASSERT_EQ(older.rows.size(), present.rows.size());
    ASSERT_EQ(older.columns, present.columns);
    for (std::size_t row = 0; row < older.rows.size(); ++row) {
        const auto& was = older.rows[row];
        const auto& is = present.rows[row];
        EXPECT_EQ(was.at("shadow_amount"), "");
        EXPECT_EQ(was.at("labels.bleed"), "");
        EXPECT_EQ(was.at("false_shadow"), is.at("false_shadow"));
        // Schema 1 has counts, which equal the amounts of nearest lookups.
        EXPECT_EQ(was.at("bias_curve.acne_free_count"), is.at("bias_curve.acne_free"));
        EXPECT_EQ(was.at("bias_curve.acne_free"), is.at("bias_curve.acne_free"));
    }
    ReportOptions options;
    options.folder = folder / "run";
    options.out = folder.path();
    EXPECT_THAT(write_report(options).schema, HasSubstr("schema 1"));
    EXPECT_THAT(store::read_text(folder / "report.html"), HasSubstr("This run is of schema 1"));
}

TEST(OlderRuns, AreNeitherResumedNorMerged)
{
    const store::TemporaryFolder folder;
    make_older_run(folder / "run");
    EXPECT_THROW((store::RunStore{folder / "run", store::RunStore::Access::write}),
                 scene::InputError);
    EXPECT_THROW((store::RunStore{folder / "run", store::RunStore::Access::read}),
                 scene::InputError);
    EXPECT_THROW(
        store::merge_runs(folder / "out", std::vector{folder / "run"}, store::Environments::one),
        scene::InputError);
}

TEST(OlderRuns, OfUnknownSchemasAreRefused)
{
    const store::TemporaryFolder folder;
    for (const int version : {0, 3}) {
        const auto run = folder / fmt::format("run{}", version);
        store::ExampleRun{1, 1}.compute(run);
        Database{store::results_path(run), Database::Access::write}.run(
            fmt::format("PRAGMA user_version = {}", version));
        EXPECT_THROW((void)store::read_run_status(run, 1), scene::InputError) << version;
    }
}

} // namespace
} // namespace gnomon::reports
