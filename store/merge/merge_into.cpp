#include "store/merge/merge.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/run/run_columns.hpp"
#include "store/run/run_schema.hpp"
#include "store/sqlite.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

namespace {

using sqlite::Database;
using sqlite::sql_name;
using sqlite::Statement;
using sqlite::Transaction;

using Names = std::vector<std::string>;

// The input is attached as `input`, the run is `main`. Row numbers differ between the two; ids,
// ordinals and the names of environments agree.

/// Selects input configurations that are in the input's plan.
constexpr std::string_view is_planned = "i.number IN (SELECT configuration FROM input.plan)";

/// The number in main of the environment of input row `i`.
constexpr std::string_view main_environment =
    "(SELECT e.number FROM main.environments e JOIN input.environments f"
    " USING (gl_renderer, gl_version, embree, gnomon) WHERE f.number = i.environment)";

template <typename Columns>
void append_names(Names& names, const Columns& columns)
{
    for (const auto& column : columns) {
        names.push_back(sql_name(column.name));
    }
}

Names curve_names()
{
    Names names{"lit", "blocked"};
    append_names(names, map_columns());
    append_names(names, bias_curve_columns());
    return names;
}

Names result_names()
{
    Names names;
    append_names(names, result_columns());
    append_names(names, error_bucket_columns());
    return names;
}

Names point_names()
{
    Names names{"point"};
    append_names(names, point_columns());
    return names;
}

Names bin_names()
{
    Names names{"job_bias", "\"at\"", "bin", "bias"};
    append_names(names, bin_columns());
    return names;
}

Names map_error_names()
{
    Names names{"map_index"};
    append_names(names, map_error_columns());
    return names;
}

/// "m.a, m.b"
std::string listed(std::string_view table, const Names& names)
{
    std::string text;
    for (const std::string& name : names) {
        text += fmt::format("{}{}.{}", text.empty() ? "" : ", ", table, name);
    }
    return text;
}

/// "a = i.a, b = i.b"
std::string assigned(const Names& names)
{
    std::string text;
    for (const std::string& name : names) {
        text += fmt::format("{}{} = i.{}", text.empty() ? "" : ", ", name, name);
    }
    return text;
}

/// The name of the first column in which rows `m` and `i` differ; NULL if they agree.
std::string differing(const Names& names)
{
    std::string text = "CASE";
    for (const std::string& name : names) {
        const bool is_quoted = name.starts_with('"');
        const std::string shown = is_quoted ? name.substr(1, name.size() - 2) : name;
        text += fmt::format(" WHEN m.{0} IS NOT i.{0} THEN '{1}'", name, shown);
    }
    return text + " END";
}

/// Finds a curve whose rows in `table` differ between main and input.
/// @param names   of the columns, without the curve.
/// @param group   a column; only rows whose value in it both sides have are compared. Empty: all
///                rows.
std::string differing_rows_query(std::string_view table, const Names& names, std::string_view group,
                                 std::string_view shown)
{
    const auto rows = [&](std::string_view schema, std::string_view number, std::string_view other,
                          std::string_view other_number) {
        std::string query = fmt::format("SELECT {} FROM {}.{} t WHERE t.curve = {}",
                                        listed("t", names), schema, table, number);
        if (!group.empty()) {
            query += fmt::format(" AND t.{0} IN (SELECT u.{0} FROM {1}.{2} u WHERE u.curve = {3})",
                                 group, other, table, other_number);
        }
        return query;
    };
    const std::string main_rows = rows("main", "m.number", "input", "i.number");
    const std::string input_rows = rows("input", "i.number", "main", "m.number");
    // CROSS JOIN fixes the order: from `main`, each input would be compared with all earlier ones.
    return fmt::format("SELECT m.id, '{0}' FROM input.curves i CROSS JOIN main.curves m"
                       " ON m.id = i.id"
                       " WHERE m.environment IS NOT NULL AND i.environment IS NOT NULL"
                       " AND (EXISTS ({1} EXCEPT {2}) OR EXISTS ({2} EXCEPT {1})) LIMIT 1",
                       shown, main_rows, input_rows);
}

/// Copies the points of curves that have results only in the input.
std::string new_points()
{
    const Names names = point_names();
    return fmt::format("INSERT INTO main.curve_points (curve, {0}) SELECT m.number, {1}"
                       " FROM input.curves i JOIN main.curves m ON m.id = i.id"
                       " JOIN input.curve_points t ON t.curve = i.number"
                       " WHERE m.environment IS NULL AND i.environment IS NOT NULL",
                       fmt::join(names, ", "), listed("t", names));
}

/// Copies the errors by distance that main lacks. Runs it after the curves: each run may have them
/// at other biases.
std::string new_bins()
{
    const Names names = bin_names();
    return fmt::format("INSERT OR IGNORE INTO main.curve_bins (curve, {0}) SELECT m.number, {1}"
                       " FROM input.curves i JOIN main.curves m ON m.id = i.id"
                       " JOIN input.curve_bins t ON t.curve = i.number WHERE m.environment = {2}",
                       fmt::join(names, ", "), listed("t", names), main_environment);
}

constexpr const char* new_environments =
    "INSERT OR IGNORE INTO main.environments (gl_renderer, gl_version, embree, gnomon)"
    " SELECT gl_renderer, gl_version, embree, gnomon FROM input.environments ORDER BY number";

std::string new_curves()
{
    Names names{"id", "scene_hash"};
    append_names(names, curve_key_columns());
    return fmt::format("INSERT OR IGNORE INTO main.curves ({}) SELECT {} FROM input.curves v"
                       " WHERE v.number IN (SELECT i.curve FROM input.configurations i WHERE {})"
                       " ORDER BY v.number",
                       fmt::join(names, ", "), listed("v", names), is_planned);
}

std::string updated_curves()
{
    return fmt::format("UPDATE main.curves AS m SET environment = {}, {} FROM input.curves i"
                       " WHERE i.id = m.id AND m.environment IS NULL"
                       " AND i.environment IS NOT NULL AND m.id IN (SELECT id FROM input.curves)",
                       main_environment, assigned(curve_names()));
}

/// Merges verifications, after the curves: each belongs to results of its own environment.
std::string merged_verifications()
{
    return fmt::format("INSERT INTO main.verifications (curve, biases, verdicts, differences)"
                       " SELECT m.number, t.biases, t.verdicts, t.differences"
                       " FROM input.verifications t JOIN input.curves i ON i.number = t.curve"
                       " JOIN main.curves m ON m.id = i.id WHERE m.environment = {}"
                       " ON CONFLICT (curve) DO UPDATE SET biases = excluded.biases,"
                       " verdicts = excluded.verdicts, differences = excluded.differences"
                       " WHERE excluded.differences > differences",
                       main_environment);
}

std::string new_configurations()
{
    Names names{"id", "status", "message", "may_pass"};
    append_names(names, configuration_key_columns());
    append_names(names, result_columns());
    append_names(names, error_bucket_columns());
    return fmt::format("INSERT INTO main.configurations (curve, environment, {})"
                       " SELECT (SELECT m.number FROM input.curves v JOIN main.curves m"
                       " ON m.id = v.id WHERE v.number = i.curve), {}, {}"
                       " FROM input.configurations i WHERE {} AND i.id NOT IN"
                       " (SELECT id FROM main.configurations) ORDER BY i.number",
                       fmt::join(names, ", "), main_environment, listed("i", names), is_planned);
}

std::string updated_configurations()
{
    Names names{"status", "message", "may_pass"};
    append_names(names, result_columns());
    append_names(names, error_bucket_columns());
    return fmt::format("UPDATE main.configurations AS m SET environment = {}, {}"
                       " FROM input.configurations i WHERE i.id = m.id AND {}"
                       " AND ((m.status <> 'done' AND i.status = 'done')"
                       " OR (m.status = 'planned' AND i.status = 'failed'))",
                       main_environment, assigned(names), is_planned);
}

constexpr const char* new_plan =
    "INSERT INTO main.plan (ordinal, configuration, \"case\", shard, job_bias, light_values)"
    " SELECT p.ordinal, (SELECT m.number FROM input.configurations i"
    " JOIN main.configurations m ON m.id = i.id WHERE i.number = p.configuration),"
    " p.\"case\", p.shard, p.job_bias, p.light_values FROM input.plan p"
    " WHERE p.ordinal NOT IN (SELECT ordinal FROM main.plan) ORDER BY p.ordinal";

/// Selects 1 if the two databases share a configuration, a curve or an ordinal, else 0. Without
/// any, no two results can differ, and none can replace another.
std::string shares_any_query()
{
    return "SELECT EXISTS (SELECT 1 FROM input.configurations i CROSS JOIN main.configurations m"
           " ON m.id = i.id) OR EXISTS (SELECT 1 FROM input.curves i CROSS JOIN main.curves m"
           " ON m.id = i.id) OR EXISTS (SELECT 1 FROM input.plan p CROSS JOIN main.plan q"
           " ON q.ordinal = p.ordinal)";
}

/// Selects an ordinal that the two plans give to different configurations.
std::string other_plan_query()
{
    return "SELECT p.ordinal FROM input.plan p"
           " JOIN input.configurations i ON i.number = p.configuration"
           " JOIN main.plan q ON q.ordinal = p.ordinal"
           " JOIN main.configurations m ON m.number = q.configuration"
           " WHERE m.id <> i.id OR p.\"case\" <> q.\"case\" OR p.job_bias <> q.job_bias"
           " OR p.light_values <> q.light_values LIMIT 1";
}

/// A query for two results that differ. Its row holds the id of their subject and a column's name.
struct Conflict {
    std::string_view subject; ///< what the id names
    std::string query;
};

std::vector<Conflict> conflict_queries()
{
    const std::string configurations =
        fmt::format("SELECT m.id, {} AS differing FROM input.configurations i"
                    " JOIN main.configurations m ON m.id = i.id WHERE m.status = 'done'"
                    " AND i.status = 'done' AND {} AND differing IS NOT NULL LIMIT 1",
                    differing(result_names()), is_planned);
    const std::string curves = fmt::format(
        "SELECT m.id, {} AS differing FROM input.curves i JOIN main.curves m ON m.id = i.id"
        " WHERE m.environment IS NOT NULL AND i.environment IS NOT NULL"
        " AND differing IS NOT NULL LIMIT 1",
        differing(curve_names()));
    return {{"configuration", configurations},
            {"curve", curves},
            {"curve", differing_rows_query("curve_points", point_names(), "", "bias curve")},
            {"curve",
             differing_rows_query("curve_bins", bin_names(), "job_bias", "error by distance")}};
}

/// For an input that has errors by map.
Conflict map_conflict_query()
{
    // Compares only maps that both sides have, because older runs have none.
    return {"configuration",
            fmt::format("SELECT m.id, 'error by map' FROM main.configurations m"
                        " JOIN input.configurations i ON i.id = m.id"
                        " JOIN main.map_errors t ON t.configuration = m.number"
                        " JOIN input.map_errors u ON u.configuration = i.number"
                        " AND u.map_index = t.map_index"
                        " WHERE m.status = 'done' AND i.status = 'done' AND ({}) <> ({}) LIMIT 1",
                        listed("t", map_error_names()), listed("u", map_error_names()))};
}

/// Copies errors by map, after all other statements.
std::string new_map_errors()
{
    const Names names = map_error_names();
    return fmt::format("INSERT OR IGNORE INTO main.map_errors (configuration, {0})"
                       " SELECT m.number, {1} FROM input.configurations i"
                       " JOIN main.configurations m ON m.id = i.id"
                       " JOIN input.map_errors t ON t.configuration = i.number"
                       " WHERE m.status = 'done' AND i.status = 'done'",
                       fmt::join(names, ", "), listed("t", names));
}

/// The statements that add the input to the main run, in this order. They are built once, because
/// thousands of files may be merged.
const std::vector<std::string>& merge_statements()
{
    static const std::vector<std::string> statements{
        new_environments, new_curves(),           new_points(),         updated_curves(),
        new_bins(),       merged_verifications(), new_configurations(), updated_configurations(),
        new_plan};
    return statements;
}

/// As `merge_statements`, for an input that shares nothing with the main run.
const std::vector<std::string>& addition_statements()
{
    // New curves have no results in main until `updated_curves` copies the input's.
    static const std::vector<std::string> statements{
        new_environments, new_curves(),           new_points(),         updated_curves(),
        new_bins(),       merged_verifications(), new_configurations(), new_plan};
    return statements;
}

void require_same_sweep(const Database& database, const std::filesystem::path& run)
{
    Statement find{database, other_plan_query()};
    if (find.step()) {
        refuse_input(run,
                     fmt::format("belongs to another sweep than the runs before it: configuration "
                                 "{} differs; merge the parts of one sweep",
                                 find.integer(0)));
    }
}

void require_no_conflict(const Database& database, const std::filesystem::path& run)
{
    std::vector<Conflict> conflicts = conflict_queries();
    if (has_map_errors(database, "input")) {
        conflicts.push_back(map_conflict_query());
    }
    for (const Conflict& conflict : conflicts) {
        Statement find{database, conflict.query};
        if (find.step()) {
            refuse_input(run,
                         fmt::format("{} {} has another {} than in the runs before it: leave one "
                                     "of them out",
                                     conflict.subject, find.text(0), find.text(1)));
        }
    }
}

} // namespace

void refuse_input(const std::filesystem::path& run, std::string_view what)
{
    throw scene::InputError(scene::one_line(fmt::format("{}: {}", run.string(), what)));
}

void merge_into(const sqlite::Database& database, const std::filesystem::path& input,
                const std::filesystem::path& run, const std::function<void()>& more)
{
    database.attach(input, "input");
    {
        Transaction transaction{database};
        const bool shares_any = database.integer(shares_any_query()) != 0;
        if (shares_any) {
            require_same_sweep(database, run);
            require_no_conflict(database, run);
        }
        // The thousands of units of a plan share nothing. Statements without effect would take most
        // of the time.
        for (const std::string& statement :
             shares_any ? merge_statements() : addition_statements()) {
            database.run(statement);
        }
        if (has_map_errors(database, "input")) {
            database.run(new_map_errors());
        }
        if (more) {
            more();
        }
        transaction.commit();
    }
    database.run("DETACH input");
}

} // namespace gnomon::store
