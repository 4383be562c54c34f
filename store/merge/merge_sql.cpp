#include "store/merge/merge_sql.hpp"

#include "store/run/run_columns.hpp"
#include "store/sqlite.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gnomon::store::merge_sql {

namespace {

using sqlite::sql_name;

using Names = std::vector<std::string>;

/// The input's configurations that its plan asks for.
constexpr std::string_view planned = "i.number IN (SELECT configuration FROM input.plan)";

/// The main number of the input's environment that row `i` names.
constexpr std::string_view environment =
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
    append_names(names, cell_columns());
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

/// The name of the first column in which rows `m` and `i` differ; NULL if there is none.
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

/// Finds a curve whose rows in `table` are not the same in both.
/// @param names   of the columns, without the curve's.
/// @param group   a column by whose values the rows are compared: those that either side lacks are
///                left out. Empty: all rows are.
std::string other_rows(std::string_view table, const Names& names, std::string_view group,
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
    // The other way round, each of many inputs would be compared with all that came before it.
    return fmt::format("SELECT m.id, '{0}' FROM input.curves i CROSS JOIN main.curves m"
                       " ON m.id = i.id"
                       " WHERE m.environment IS NOT NULL AND i.environment IS NOT NULL"
                       " AND (EXISTS ({1} EXCEPT {2}) OR EXISTS ({2} EXCEPT {1})) LIMIT 1",
                       shown, main_rows, input_rows);
}

/// Copies the points of curves that only the input has results of.
std::string new_points()
{
    const Names names = point_names();
    return fmt::format("INSERT INTO main.curve_points (curve, {0}) SELECT m.number, {1}"
                       " FROM input.curves i JOIN main.curves m ON m.id = i.id"
                       " JOIN input.curve_points t ON t.curve = i.number"
                       " WHERE m.environment IS NULL AND i.environment IS NOT NULL",
                       fmt::join(names, ", "), listed("t", names));
}

/// Copies the errors by distance that the union lacks, after the curves: each run may have them at
/// other jobs' biases.
std::string new_bins()
{
    const Names names = bin_names();
    return fmt::format("INSERT OR IGNORE INTO main.curve_bins (curve, {0}) SELECT m.number, {1}"
                       " FROM input.curves i JOIN main.curves m ON m.id = i.id"
                       " JOIN input.curve_bins t ON t.curve = i.number WHERE m.environment = {2}",
                       fmt::join(names, ", "), listed("t", names), environment);
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
                       fmt::join(names, ", "), listed("v", names), planned);
}

std::string better_curves()
{
    return fmt::format("UPDATE main.curves AS m SET environment = {}, {} FROM input.curves i"
                       " WHERE i.id = m.id AND m.environment IS NULL"
                       " AND i.environment IS NOT NULL AND m.id IN (SELECT id FROM input.curves)",
                       environment, assigned(curve_names()));
}

/// After the curves: a verification is of the results that came from its own environment.
std::string worst_verifications()
{
    return fmt::format("INSERT INTO main.verifications (curve, biases, verdicts, differences)"
                       " SELECT m.number, t.biases, t.verdicts, t.differences"
                       " FROM input.verifications t JOIN input.curves i ON i.number = t.curve"
                       " JOIN main.curves m ON m.id = i.id WHERE m.environment = {}"
                       " ON CONFLICT (curve) DO UPDATE SET biases = excluded.biases,"
                       " verdicts = excluded.verdicts, differences = excluded.differences"
                       " WHERE excluded.differences > differences",
                       environment);
}

std::string new_configurations()
{
    Names names{"id", "status", "message", "may_pass"};
    append_names(names, configuration_key_columns());
    append_names(names, result_columns());
    append_names(names, cell_columns());
    return fmt::format("INSERT INTO main.configurations (curve, environment, {})"
                       " SELECT (SELECT m.number FROM input.curves v JOIN main.curves m"
                       " ON m.id = v.id WHERE v.number = i.curve), {}, {}"
                       " FROM input.configurations i WHERE {} AND i.id NOT IN"
                       " (SELECT id FROM main.configurations) ORDER BY i.number",
                       fmt::join(names, ", "), environment, listed("i", names), planned);
}

std::string better_configurations()
{
    Names names{"status", "message", "may_pass"};
    append_names(names, result_columns());
    append_names(names, cell_columns());
    return fmt::format("UPDATE main.configurations AS m SET environment = {}, {}"
                       " FROM input.configurations i WHERE i.id = m.id AND {}"
                       " AND ((m.status <> 'done' AND i.status = 'done')"
                       " OR (m.status = 'planned' AND i.status = 'failed'))",
                       environment, assigned(names), planned);
}

constexpr const char* new_plan =
    "INSERT INTO main.plan (ordinal, configuration, \"case\", shard, job_bias, light_values)"
    " SELECT p.ordinal, (SELECT m.number FROM input.configurations i"
    " JOIN main.configurations m ON m.id = i.id WHERE i.number = p.configuration),"
    " p.\"case\", p.shard, p.job_bias, p.light_values FROM input.plan p"
    " WHERE p.ordinal NOT IN (SELECT ordinal FROM main.plan) ORDER BY p.ordinal";

} // namespace

std::string shares_any()
{
    return "SELECT EXISTS (SELECT 1 FROM input.configurations i CROSS JOIN main.configurations m"
           " ON m.id = i.id) OR EXISTS (SELECT 1 FROM input.curves i CROSS JOIN main.curves m"
           " ON m.id = i.id) OR EXISTS (SELECT 1 FROM input.plan p CROSS JOIN main.plan q"
           " ON q.ordinal = p.ordinal)";
}

std::string other_plan()
{
    return "SELECT p.ordinal FROM input.plan p"
           " JOIN input.configurations i ON i.number = p.configuration"
           " JOIN main.plan q ON q.ordinal = p.ordinal"
           " JOIN main.configurations m ON m.number = q.configuration"
           " WHERE m.id <> i.id OR p.\"case\" <> q.\"case\" OR p.job_bias <> q.job_bias"
           " OR p.light_values <> q.light_values LIMIT 1";
}

std::vector<Conflict> conflicts()
{
    const std::string configurations =
        fmt::format("SELECT m.id, {} AS differing FROM input.configurations i"
                    " JOIN main.configurations m ON m.id = i.id WHERE m.status = 'done'"
                    " AND i.status = 'done' AND {} AND differing IS NOT NULL LIMIT 1",
                    differing(result_names()), planned);
    const std::string curves = fmt::format(
        "SELECT m.id, {} AS differing FROM input.curves i JOIN main.curves m ON m.id = i.id"
        " WHERE m.environment IS NOT NULL AND i.environment IS NOT NULL"
        " AND differing IS NOT NULL LIMIT 1",
        differing(curve_names()));
    return {{"configuration", configurations},
            {"curve", curves},
            {"curve", other_rows("curve_points", point_names(), "", "bias curve")},
            {"curve", other_rows("curve_bins", bin_names(), "job_bias", "error by distance")}};
}

Conflict map_conflict()
{
    // Those that either side lacks are left out: an older run has none.
    return {"configuration",
            fmt::format("SELECT m.id, 'error by map' FROM main.configurations m"
                        " JOIN input.configurations i ON i.id = m.id"
                        " JOIN main.map_errors t ON t.configuration = m.number"
                        " JOIN input.map_errors u ON u.configuration = i.number"
                        " AND u.map_index = t.map_index"
                        " WHERE m.status = 'done' AND i.status = 'done' AND ({}) <> ({}) LIMIT 1",
                        listed("t", map_error_names()), listed("u", map_error_names()))};
}

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

const std::vector<std::string>& merge_statements()
{
    static const std::vector<std::string> statements{
        new_environments, new_curves(),          new_points(),         better_curves(),
        new_bins(),       worst_verifications(), new_configurations(), better_configurations(),
        new_plan};
    return statements;
}

const std::vector<std::string>& addition_statements()
{
    // The curves have no results in the main run until they are given those of the input.
    static const std::vector<std::string> statements{
        new_environments, new_curves(),          new_points(),         better_curves(),
        new_bins(),       worst_verifications(), new_configurations(), new_plan};
    return statements;
}

} // namespace gnomon::store::merge_sql
