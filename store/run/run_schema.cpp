#include "store/run/run_schema.hpp"

#include "analysis/results/metric_table.hpp"
#include "scene/error.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/text.hpp"
#include "store/run/run_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::store {

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
                                   " job_bias TEXT NOT NULL, light_values TEXT NOT NULL)";

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
                       definitions(error_bucket_columns()));
}

std::string bins_table()
{
    return fmt::format("CREATE TABLE curve_bins (curve INTEGER NOT NULL REFERENCES curves,"
                       " job_bias TEXT NOT NULL, \"at\" TEXT NOT NULL, bin INTEGER, bias REAL{},"
                       " PRIMARY KEY (curve, job_bias, \"at\", bin)) WITHOUT ROWID",
                       definitions(bin_columns()));
}

constexpr std::string_view map_errors = "map_errors";

/// Not among `table_statements`, because older runs without it stay readable.
std::string map_errors_table()
{
    return fmt::format("CREATE TABLE {} (configuration INTEGER NOT NULL REFERENCES configurations,"
                       " map_index INTEGER{}, PRIMARY KEY (configuration, map_index))"
                       " WITHOUT ROWID",
                       map_errors, definitions(map_error_columns()));
}

/// The rows of `plan` that this run computes: all, unless the sweep is divided.
std::string part_view()
{
    return "CREATE VIEW part AS SELECT * FROM plan"
           " WHERE (SELECT value FROM run WHERE key = 'shard_count') = 1"
           " OR shard = (SELECT value FROM run WHERE key = 'shard_index')";
}

std::string results_view(const std::vector<std::string>& light_columns)
{
    std::string columns;
    for (const ResultsColumn& column : results_columns(light_columns)) {
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

/// All rates as columns, each after a comma; NULL for a denominator of 0.
/// @param errors  table of the wrong pixels.
/// @param pixels  table of all pixels.
std::string rates(std::string_view errors, std::string_view pixels)
{
    std::string columns;
    for (const analysis::SubsetRate& rate : analysis::subset_rates()) {
        columns += fmt::format(", CAST({} AS REAL) / nullif({}, 0) AS {}",
                               sum_of(rate.errors, errors), sum_of(rate.pixels, pixels), rate.name);
    }
    return columns;
}

} // namespace

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

std::vector<std::string> table_statements()
{
    return {run_table,  environments_table, curves_table(), configurations_table(),
            plan_table, points_table(),     bins_table(),   verifications_table};
}

std::vector<std::string> view_statements(const std::vector<std::string>& light_columns)
{
    return {part_view(), results_view(light_columns),
            "CREATE VIEW error_vs_z AS SELECT " + error_vs_z_columns(), bias_curves_view()};
}

std::vector<std::string> schema_statements(const std::vector<std::string>& light_columns)
{
    std::vector<std::string> all = table_statements();
    const std::vector<std::string> views = view_statements(light_columns);
    all.insert(all.end(), views.begin(), views.end());
    return all;
}

[[noreturn]] void refuse_database(const Database& database, std::string_view what)
{
    throw scene::InputError(fmt::format("{}: {}: name another folder",
                                        scene::one_line(database.path().string()), what));
}

/// Whether a table or view was created by this very statement; SQLite keeps its text.
bool was_made_by(const Database& database, const std::string& statement)
{
    Statement search{database, "SELECT 1 FROM sqlite_schema WHERE sql = ?"};
    return search.bind(1, std::string_view{statement}).first().has_value();
}

/// Whether the database has no tables: it is new, or the disk was full when they were created.
bool is_empty(const Database& database)
{
    return database.integer("SELECT count(*) FROM sqlite_schema") == 0;
}

void create_schema(const Database& database)
{
    for (const std::string& statement : schema_statements({})) {
        database.run(statement);
    }
    database.run(map_errors_table());
    database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application_id,
                             run_schema));
}

constexpr std::int64_t oldest_readable = 1;

/// Makes a CREATE statement create something that only this connection sees.
std::string made_temporary(const std::string& statement)
{
    constexpr std::string_view create = "CREATE ";
    return fmt::format("{}TEMP {}", create, std::string_view{statement}.substr(create.size()));
}

std::vector<std::string> column_names(const Database& database, const std::string& table)
{
    std::vector<std::string> names;
    Statement columns{database,
                      fmt::format("SELECT name FROM pragma_table_info({})", sql_name(table))};
    while (columns.step()) {
        names.push_back(columns.text(0));
    }
    return names;
}

/// The expression that selects a present column from an older table; empty if it lacks the column.
std::string older_expression(const std::string& column, const std::vector<std::string>& older)
{
    const auto has = [&](const std::string& name) {
        return std::ranges::find(older, name) != older.end();
    };
    // In schema 1, `acne_free` held the limit by pixel count.
    constexpr std::string_view acne_free = "acne_free";
    constexpr std::string_view acne_free_count = "acne_free_count";
    if (column.ends_with(acne_free_count) && !has(column)) {
        const std::string counted =
            column.substr(0, column.size() - acne_free_count.size()) + std::string{acne_free};
        return has(counted) ? sql_name(counted) : std::string{};
    }
    if (column.ends_with(acne_free) && has(column)) {
        return fmt::format("CASE WHEN \"lookup.filter\" IN ('nearest', 'linear') THEN {} END",
                           sql_name(column));
    }
    return has(column) ? sql_name(column) : std::string{};
}

/// Shows an older table in the present schema.
/// @param lacks  receives the columns that the table lacks.
void show_older_table(const Database& database, const std::string& statement,
                      std::vector<std::string>& lacks)
{
    constexpr std::string_view create = "CREATE TABLE ";
    const std::string table =
        statement.substr(create.size(), statement.find(' ', create.size()) - create.size());
    const std::vector<std::string> older = column_names(database, table);
    if (older.empty()) {
        refuse_database(database, fmt::format("is a run of schema 1 without the table {}", table));
    }
    database.run(made_temporary(statement)); // hides the older table until it is dropped
    const std::vector<std::string> present = column_names(database, table);
    database.run(fmt::format("DROP TABLE temp.{}", table));
    std::string columns;
    for (const std::string& column : present) {
        const std::string expression = older_expression(column, older);
        columns += fmt::format("{}{} AS {}", columns.empty() ? "" : ", ",
                               expression.empty() ? "NULL" : expression, sql_name(column));
        if (expression.empty() && std::ranges::find(lacks, column) == lacks.end()) {
            lacks.push_back(column);
        }
    }
    database.run(fmt::format("CREATE TEMP VIEW {0} AS SELECT {1} FROM main.{0}", table, columns));
}

} // namespace

RunSchema prepare_reading(const Database& database)
{
    const std::int64_t version = database.integer("PRAGMA user_version");
    if (version < oldest_readable || version >= run_schema ||
        database.integer("PRAGMA application_id") != application_id) {
        require_run_schema(database);
        return {};
    }
    RunSchema schema{version, {}};
    for (const std::string& statement : table_statements()) {
        show_older_table(database, statement, schema.lacks);
    }
    for (const std::string& statement : view_statements({})) {
        database.run(made_temporary(statement));
    }
    return schema;
}

std::string schema_text(const RunSchema& schema)
{
    if (schema.version == run_schema) {
        return {};
    }
    constexpr std::size_t shown = 3;
    const std::size_t named = std::min(schema.lacks.size(), shown);
    const std::string others = schema.lacks.size() > named
                                   ? fmt::format(" and {} others", schema.lacks.size() - named)
                                   : std::string{};
    return fmt::format(
        "this run is of schema {}: an older Gnomon wrote it, which did not know {}{}, and "
        "defined causes, names and gaps otherwise; computed anew into another folder "
        "it has them",
        schema.version,
        fmt::join(schema.lacks.begin(), schema.lacks.begin() + static_cast<std::ptrdiff_t>(named),
                  ", "),
        others);
}

std::filesystem::path results_path(const std::filesystem::path& folder)
{
    return folder / "results.sqlite";
}

void require_run_schema(const Database& database)
{
    if (is_empty(database)) {
        throw scene::InputError(
            scene::one_line(fmt::format("{}: nothing is recorded in it yet, for the run was cut "
                                        "off as it was begun: repeat the "
                                        "command that began it",
                                        database.path().string())));
    }
    if (database.integer("PRAGMA application_id") != application_id) {
        refuse_database(database, "is a database, but not of a sweep's results");
    }
    const auto version = database.integer("PRAGMA user_version");
    if (version != run_schema) {
        refuse_database(database, fmt::format("its schema is {}, this Gnomon's is {}; compute it "
                                              "anew",
                                              version, run_schema));
    }
    // An added or removed key or metric changes the columns.
    std::vector<std::string> statements = schema_statements(light_columns(database));
    if (has_map_errors(database)) {
        statements.push_back(map_errors_table());
    }
    for (const std::string& statement : statements) {
        if (!was_made_by(database, statement)) {
            refuse_database(database, "a Gnomon with other keys or results wrote it");
        }
    }
}

bool has_map_errors(const Database& database, const std::string& schema)
{
    return database.integer(fmt::format("SELECT count(*) FROM {}.sqlite_schema"
                                        " WHERE type = 'table' AND name = '{}'",
                                        sql_name(schema), map_errors)) > 0;
}

void show_light_columns(const Database& database)
{
    const std::string view = results_view(light_columns(database));
    if (!was_made_by(database, view)) {
        database.run("DROP VIEW results");
        database.run(view);
    }
}

void prepare_run(Database& database)
{
    const bool is_new = is_empty(database);
    if (!is_new) {
        require_run_schema(database); // before changing a file that may not be ours
        database.require_sound();
    }
    database.enter_wal_mode();
    database.run("PRAGMA cache_size = -32768"); // KiB
    if (is_new) {
        Transaction transaction{database};
        create_schema(database);
        transaction.commit();
    } else if (!has_map_errors(database)) {
        database.run(map_errors_table());
    }
}

} // namespace gnomon::store
