#include "reports/run/run_schema.hpp"

#include "analysis/part_table.hpp"
#include "reports/run/run_columns.hpp"
#include "scene/error.hpp"
#include "scene/job_toml.hpp"
#include "scene/sweep_space.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using sqlite::Database;
using sqlite::sql_name;
using sqlite::Statement;
using sqlite::Transaction;

constexpr int application_id = 0x474E4D4E; ///< "GNMN"

template <typename Columns>
std::string definitions(const Columns& columns)
{
    std::string text;
    for (const auto& column : columns) {
        text += fmt::format(", {} {}", sql_name(column.name), column.type);
    }
    return text;
}

constexpr const char* run_table = "CREATE TABLE run (key TEXT PRIMARY KEY, value) WITHOUT ROWID";

constexpr const char* environments_table =
    "CREATE TABLE environments (number INTEGER PRIMARY KEY, gl_renderer TEXT NOT NULL,"
    " gl_version TEXT NOT NULL, embree TEXT NOT NULL, gnomon TEXT NOT NULL,"
    " UNIQUE (gl_renderer, gl_version, embree, gnomon))";

constexpr const char* plan_table = "CREATE TABLE plan (ordinal INTEGER PRIMARY KEY,"
                                   " configuration INTEGER NOT NULL REFERENCES configurations,"
                                   " \"case\" TEXT NOT NULL, shard INTEGER NOT NULL,"
                                   " job_bias TEXT NOT NULL)";

std::string points_table()
{
    return fmt::format("CREATE TABLE curve_points (curve INTEGER NOT NULL REFERENCES curves,"
                       " point INTEGER{}, PRIMARY KEY (curve, point)) WITHOUT ROWID",
                       definitions(point_columns()));
}

constexpr const char* verifications_table =
    "CREATE TABLE verifications (curve INTEGER PRIMARY KEY REFERENCES curves,"
    " biases INTEGER NOT NULL, verdicts INTEGER NOT NULL, differences INTEGER NOT NULL)";

std::string curves_table()
{
    return fmt::format("CREATE TABLE curves (number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE,"
                       " scene_hash TEXT NOT NULL{}, environment INTEGER REFERENCES environments,"
                       " lit INTEGER, blocked INTEGER{}{})",
                       definitions(curve_key_columns()), definitions(map_columns()),
                       definitions(bias_curve_columns()));
}

std::string configurations_table()
{
    return fmt::format("CREATE TABLE configurations (number INTEGER PRIMARY KEY,"
                       " id TEXT NOT NULL UNIQUE, curve INTEGER NOT NULL REFERENCES curves,"
                       " environment INTEGER REFERENCES environments, status TEXT NOT NULL,"
                       " message TEXT, may_pass INTEGER{}{}{})",
                       definitions(configuration_key_columns()), definitions(result_columns()),
                       definitions(part_columns()));
}

std::string bins_table()
{
    return fmt::format("CREATE TABLE curve_bins (curve INTEGER NOT NULL REFERENCES curves,"
                       " job_bias TEXT NOT NULL, \"at\" TEXT NOT NULL, bin INTEGER, bias REAL{},"
                       " PRIMARY KEY (curve, job_bias, \"at\", bin)) WITHOUT ROWID",
                       definitions(bin_columns()));
}

/// The rows of `plan` that this run computes: all of them unless the sweep is divided.
std::string part_view()
{
    return "CREATE VIEW part AS SELECT * FROM plan"
           " WHERE (SELECT value FROM run WHERE key = 'shard_count') = 1"
           " OR shard = (SELECT value FROM run WHERE key = 'shard_index')";
}

std::string results_view()
{
    std::string columns;
    for (const ResultsColumn& column : results_columns()) {
        columns += fmt::format("{}{} AS {}", columns.empty() ? "" : ", ", column.expression,
                               sql_name(column.name));
    }
    return fmt::format("CREATE VIEW results AS SELECT {} FROM {}", columns, results_tables());
}

/// The sum of columns of a table.
std::string sum_of(std::span<const std::string_view> names, std::string_view table)
{
    std::string sum;
    for (const std::string_view name : names) {
        sum += fmt::format("{}{}.{}", sum.empty() ? "" : " + ", table, name);
    }
    return sum;
}

/// All rates as columns, each after a comma; NULL where there is nothing to divide by.
/// @param errors  the table of what is wrong.
/// @param pixels  that of what there is.
std::string rates(std::string_view errors, std::string_view pixels)
{
    std::string columns;
    for (const analysis::PartRate& rate : analysis::part_rates()) {
        columns += fmt::format(", CAST({} AS REAL) / nullif({}, 0) AS {}",
                               sum_of(rate.errors, errors), sum_of(rate.pixels, pixels), rate.name);
    }
    return columns;
}

} // namespace

std::vector<ResultsColumn> results_columns()
{
    using Of = ResultsColumn::Of;
    std::vector<ResultsColumn> all{{"schema", fmt::format("{}", run_schema), Of::curve},
                                   {"ordinal", "p.ordinal", Of::configuration},
                                   {"id", "c.id", Of::configuration},
                                   {"curve", "k.id", Of::curve},
                                   {"case", "p.\"case\"", Of::configuration},
                                   {"status", "c.status", Of::configuration},
                                   {"message", "c.message", Of::configuration},
                                   {"scene_hash", "k.scene_hash", Of::curve}};
    const auto add = [&](const auto& columns, std::string_view table, Of of) {
        for (const auto& column : columns) {
            all.push_back({column.name, fmt::format("{}.{}", table, sql_name(column.name)), of});
        }
    };
    for (const JobColumn& column : job_columns()) {
        const bool is_own = is_configuration_key(column.name);
        add(std::array{column}, is_own ? "c" : "k", is_own ? Of::configuration : Of::curve);
    }
    add(map_columns(), "v", Of::curve);
    add(result_columns(), "c", Of::configuration);
    add(bias_curve_columns(), "v", Of::curve);
    return all;
}

std::string results_tables()
{
    return "part p CROSS JOIN configurations c ON c.number = p.configuration"
           " JOIN curves k ON k.number = c.curve"
           " LEFT JOIN curves v ON v.number = c.curve AND c.status = 'done'";
}

std::string error_vs_z_columns()
{
    std::string counts;
    std::string depths; // from the first quantile on
    for (const auto& column : bin_columns()) {
        const bool is_count = depths.empty() && column.name.find('.') == std::string::npos;
        (is_count ? counts : depths) += fmt::format(", b.{}", sql_name(column.name));
    }
    return fmt::format("v.id AS curve, b.\"at\" AS \"at\", b.bias AS bias{}{}{}"
                       " FROM curve_bins b JOIN curves v ON v.number = b.curve",
                       counts, rates("b", "b"), depths);
}

namespace {

std::string bias_curves_view()
{
    std::string columns;
    for (const auto& column : point_columns()) {
        columns += fmt::format(", b.{0} AS {0}", sql_name(column.name));
    }
    return fmt::format("CREATE VIEW bias_curves AS SELECT v.id AS curve{}{}"
                       " FROM curve_points b JOIN curves v ON v.number = b.curve",
                       columns, rates("b", "v"));
}

std::vector<std::string> schema_statements()
{
    return {run_table,
            environments_table,
            curves_table(),
            configurations_table(),
            plan_table,
            points_table(),
            bins_table(),
            verifications_table,
            part_view(),
            results_view(),
            "CREATE VIEW error_vs_z AS SELECT " + error_vs_z_columns(),
            bias_curves_view()};
}

[[noreturn]] void refuse_database(const Database& database, std::string_view what)
{
    throw scene::InputError(fmt::format("{}: {}: name another folder",
                                        scene::one_line(database.path().string()), what));
}

/// As SQLite keeps it, the text of what makes a table or a view.
bool was_made_by(const Database& database, const std::string& statement)
{
    Statement search{database, "SELECT 1 FROM sqlite_schema WHERE sql = ?"};
    return search.bind(1, std::string_view{statement}).first().has_value();
}

void create_schema(const Database& database)
{
    for (const std::string& statement : schema_statements()) {
        database.run(statement);
    }
    database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application_id,
                             run_schema));
}

} // namespace

std::filesystem::path results_path(const std::filesystem::path& folder)
{
    return folder / "results.sqlite";
}

void require_run_schema(const Database& database)
{
    if (database.integer("PRAGMA application_id") != application_id) {
        refuse_database(database, "is a database, but not of a sweep's results");
    }
    const auto version = database.integer("PRAGMA user_version");
    if (version != run_schema) {
        refuse_database(database, fmt::format("its schema is {}, this Gnomon's is {}; compute it "
                                              "anew",
                                              version, run_schema));
    }
    // A key or a result that came or went makes other columns.
    for (const std::string& statement : schema_statements()) {
        if (!was_made_by(database, statement)) {
            refuse_database(database, "a Gnomon with other keys or results wrote it");
        }
    }
}

void prepare_run(Database& database)
{
    const bool is_new = database.integer("SELECT count(*) FROM sqlite_schema") == 0;
    if (!is_new) {
        require_run_schema(database); // before anything of somebody else's is changed
        database.require_sound();
    }
    database.enter_wal_mode();
    database.run("PRAGMA cache_size = -32768"); // KiB
    if (is_new) {
        Transaction transaction{database};
        create_schema(database);
        transaction.commit();
    }
}

} // namespace gnomon::reports
