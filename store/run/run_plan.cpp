#include "store/run/run_plan.hpp"

#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"
#include "store/run/run_columns.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::store {

namespace {

using analysis::Configuration;
using analysis::Environment;
using sqlite::Database;
using sqlite::sql_name;
using sqlite::Statement;
using sqlite::Transaction;
using sqlite::Value;

/// The keys that name a scene; each job has one of them.
constexpr auto scene_name_keys = std::to_array<std::string_view>({"scene.builtin", "scene.file"});

/// The column of a job key, in table `configurations` c or `curves` v: "c."scene.file"".
std::string key_column(std::string_view key)
{
    return fmt::format("{}.{}", is_configuration_key(key) ? "c" : "v", sqlite::sql_name(key));
}

/// "INSERT INTO table (first, …, columns) VALUES (?, …)", followed by `rest`.
std::string insertion(std::string_view table, std::string_view first, int first_count,
                      const std::vector<JobColumn>& columns, std::string_view rest)
{
    std::string names;
    std::string values = "?";
    for (int i = 1; i < first_count; ++i) {
        values += ", ?";
    }
    for (const JobColumn& column : columns) {
        names += ", " + sql_name(column.name);
        values += ", ?";
    }
    return fmt::format("INSERT INTO {} ({}{}) VALUES ({}){}", table, first, names, values, rest);
}

/// Binds a configuration's job keys to the parameters of a statement.
class KeyParameters {
public:
    /// @param first  parameter of the first column.
    KeyParameters(int first, const std::vector<JobColumn>& columns)
    {
        for (const JobColumn& column : columns) {
            parameters_.emplace_back(column.name, first++);
        }
    }

    /// Binds NULL to keys that the configuration lacks.
    void bind(Statement& statement, const Configuration& configuration) const
    {
        const auto& held = configuration.parameters;
        for (const auto& [key, parameter] : parameters_) {
            const auto found =
                std::ranges::find(held, key, &std::pair<std::string, std::string>::first);
            statement.bind(parameter, found == held.end() ? Value{} : job_cell(found->second));
        }
    }

private:
    std::vector<std::pair<std::string_view, int>> parameters_; ///< keys and their parameters
};

Json json_of(const Value& cell)
{
    if (const auto* text = std::get_if<std::string>(&cell)) {
        return *text;
    }
    if (const auto* integer = std::get_if<std::int64_t>(&cell)) {
        return *integer;
    }
    const auto* const real = std::get_if<double>(&cell);
    return real == nullptr ? Json(nullptr) : Json(*real);
}

/// The JSON that `light_columns` select from.
std::string light_values_text(const Configuration& configuration)
{
    Json values = Json::object();
    for (const auto& [key, value] : configuration.light_values) {
        values[key] = json_of(job_cell(value));
    }
    return json_text(values, -1);
}

/// Writes configurations into the plan.
class Planner {
public:
    explicit Planner(const Database& database)
        : database_{&database},
          insert_{database, insertion("configurations", "id, curve, status", 3,
                                      configuration_key_columns(), " ON CONFLICT (id) DO NOTHING")},
          find_{database, "SELECT number FROM configurations WHERE id = ?"},
          insert_curve_{database, insertion("curves", "id, scene_hash", 2, curve_key_columns(),
                                            " ON CONFLICT (id) DO NOTHING")},
          find_curve_{database, "SELECT number FROM curves WHERE id = ?"},
          plan_{database, "INSERT OR IGNORE INTO plan VALUES (?, ?, ?, ?, ?, ?)"}
    {
    }

    void add(const Configuration& configuration)
    {
        const std::int64_t number = configuration_number(configuration);
        remember_planned(static_cast<std::size_t>(number));
        remember_engine_keys(configuration);
        plan_.bind(1, static_cast<std::int64_t>(configuration.ordinal))
            .bind(2, number)
            .bind(3, std::string_view{configuration.case_name})
            .bind(4, std::int64_t{configuration.shard})
            .bind(5, std::string_view{configuration.job_bias})
            .bind(6, Value{light_values_text(configuration)})
            .run();
        if (database_->changes() != 1) {
            throw std::invalid_argument(fmt::format(
                "RunStore::plan: two configurations of ordinal {}", configuration.ordinal));
        }
    }

    [[nodiscard]] bool has_equal_ids() const { return has_equal_ids_; }
    /// The engine keys of all configurations, sorted.
    [[nodiscard]] const std::set<std::string>& engine_keys() const { return engine_keys_; }

private:
    void remember_engine_keys(const Configuration& configuration)
    {
        for (const auto& [key, value] : configuration.light_values) {
            if (scene::is_engine_key(key)) {
                engine_keys_.insert(key);
            }
        }
    }

    void remember_planned(std::size_t number)
    {
        is_planned_.resize(std::max(is_planned_.size(), number + 1));
        has_equal_ids_ = has_equal_ids_ || is_planned_[number];
        is_planned_[number] = true;
    }

    /// Inserts a row unless its id is known; returns the row's number.
    std::int64_t insert(Statement& insertion, Statement& find, const std::string& id)
    {
        insertion.run();
        if (database_->changes() == 1) {
            return database_->last_inserted();
        }
        return find.bind(1, std::string_view{id}).first().value_or(0); // the row exists
    }

    std::int64_t configuration_number(const Configuration& configuration)
    {
        insert_.bind(1, std::string_view{configuration.id})
            .bind(2, curve_number(configuration))
            .bind(3, std::string_view{"planned"});
        own_keys_.bind(insert_, configuration);
        return insert(insert_, find_, configuration.id);
    }

    std::int64_t curve_number(const Configuration& configuration)
    {
        const auto [entry, is_new] = curves_.try_emplace(configuration.curve);
        if (is_new) {
            require_known_keys(configuration);
            insert_curve_.bind(1, std::string_view{configuration.curve})
                .bind(2, std::string_view{configuration.scene_hash});
            curve_keys_.bind(insert_curve_, configuration);
            entry->second = insert(insert_curve_, find_curve_, configuration.curve);
        }
        return entry->second;
    }

    static void require_known_keys(const Configuration& configuration)
    {
        for (const auto& [key, value] : configuration.parameters) {
            if (std::ranges::find(job_columns(), key, &JobColumn::name) == job_columns().end()) {
                throw std::invalid_argument(fmt::format("RunStore::plan: no job key {}", key));
            }
        }
    }

    const Database* database_;
    Statement insert_;
    Statement find_;
    Statement insert_curve_;
    Statement find_curve_;
    Statement plan_;
    KeyParameters own_keys_{4, configuration_key_columns()}; ///< of `insert_`
    KeyParameters curve_keys_{3, curve_key_columns()};       ///< of `insert_curve_`
    std::unordered_map<std::string, std::int64_t> curves_;   ///< numbers by id
    std::set<std::string> engine_keys_;
    std::vector<bool> is_planned_; ///< by number of the configuration
    bool has_equal_ids_ = false;
};

/// Deletes configurations that are no longer planned, unless they have results. Returns how many
/// such results stay.
std::uint64_t retire(const Database& database)
{
    const std::string unplanned = "number NOT IN (SELECT configuration FROM plan)";
    database.run("DELETE FROM configurations WHERE status = 'planned' AND " + unplanned);
    return static_cast<std::uint64_t>(database.integer(
        "SELECT count(*) FROM configurations WHERE status = 'done' AND " + unplanned));
}

void require_valid(const Shard& shard)
{
    if (shard.index < 1 || shard.index > shard.count) {
        throw std::invalid_argument(
            fmt::format("RunStore::plan: shard {} of {}", shard.index, shard.count));
    }
}

void write_value(const Database& database, std::string_view key, const Value& value)
{
    Statement{database, "INSERT OR REPLACE INTO run VALUES (?, ?)"}
        .bind(1, key)
        .bind(2, value)
        .run();
}

/// A renderer's engine keys become columns of `results`.
void write_engine_keys(const Database& database, const std::set<std::string>& keys)
{
    database.run("DELETE FROM run WHERE key = 'engine_keys'");
    if (!keys.empty()) {
        write_value(database, "engine_keys", json_text(Json(keys), -1));
    }
    show_light_columns(database);
}

} // namespace

PlannedScenes::PlannedScenes(const sqlite::Database& database)
{
    std::string columns;
    for (const std::string_view key : scene_name_keys) {
        columns += ", " + key_column(key);
    }
    sqlite::Statement rows{database, "SELECT DISTINCT v.scene_hash" + columns +
                                         " FROM plan p JOIN configurations c ON c.number ="
                                         " p.configuration JOIN curves v ON v.number = c.curve"
                                         " WHERE c.status = 'done'"};
    while (rows.step()) {
        hashes_.insert(rows.text(0));
        int column = 1;
        for (const std::string_view key : scene_name_keys) {
            if (!rows.is_null(column) && !rows.text(column).empty()) {
                names_.emplace(key, rows.text(column));
            }
            ++column;
        }
    }
}

bool PlannedScenes::contain(const analysis::Configuration& configuration) const
{
    return hashes_.contains(configuration.scene_hash) ||
           std::ranges::any_of(configuration.parameters, [&](const auto& parameter) {
               const sqlite::Value value = job_cell(parameter.second);
               const auto* const text = std::get_if<std::string>(&value);
               return text != nullptr && names_.contains({parameter.first, *text});
           });
}

void write_description(const Database& database, const RunDescription& description)
{
    write_value(database, "environment", record_environment(database, description.environment));
    write_value(database, "shard_index", std::int64_t{description.shard.index});
    write_value(database, "shard_count", std::int64_t{description.shard.count});
    write_value(database, "size", static_cast<std::int64_t>(description.size));
    write_value(database, "axes", json_text(Json(description.axes), -1));
    write_value(database, "lights", json_text(Json(description.lights), -1));
    write_value(database, "job", description.job);
    write_value(database, "command", description.command);
    write_value(database, "compare_command", description.compare_command);
    write_value(database, "notes", notes_json(description.notes));
    show_light_columns(database);
}

PlanOutcome write_plan(const Database& database, const RunDescription& description,
                       const ShowConfigurations& show, Environments environments,
                       OtherScenes other_scenes)
{
    require_valid(description.shard);
    Transaction transaction{database};
    if (environments == Environments::one) {
        require_one_environment(database, description.environment);
    }
    const PlannedScenes earlier{database};
    write_description(database, description);
    database.run("DELETE FROM plan");
    const bool has_earlier_rows = has_configurations(database);
    Planner planner{database};
    bool has_known_scene = earlier.empty() || other_scenes == OtherScenes::replaced;
    show([&](const Configuration& configuration) {
        planner.add(configuration);
        has_known_scene = has_known_scene || earlier.contain(configuration);
    });
    write_engine_keys(database, planner.engine_keys());
    if (!has_known_scene) {
        throw scene::InputError(scene::one_line(fmt::format(
            "{}: holds results of another scene, {}: name another folder, or pass --force to "
            "replace them",
            database.path().parent_path().string(), earlier.example())));
    }
    const std::uint64_t retired = has_earlier_rows ? retire(database) : 0;
    PlanOutcome result = read_outcome(database);
    result.retired = retired;
    result.has_equal_ids = planner.has_equal_ids();
    transaction.commit();
    return result;
}

bool has_configurations(const Database& database)
{
    return database.integer("SELECT 1 FROM configurations LIMIT 1") == 1;
}

PlanOutcome read_outcome(const Database& database)
{
    Statement counts{database, "SELECT coalesce(sum(c.status = 'done'), 0),"
                               " coalesce(sum(c.status = 'failed'), 0),"
                               " coalesce(sum(c.status = 'planned'), 0)"
                               " FROM part p CROSS JOIN configurations c"
                               " ON c.number = p.configuration"};
    counts.step(); // an aggregate has one row
    const auto count = [&](int column) {
        return static_cast<std::uint64_t>(counts.integer(column));
    };
    PlanOutcome result;
    result.done = count(0);
    result.failed = count(1);
    result.planned = count(2);
    return result;
}

std::uint64_t read_retriable(const Database& database)
{
    return static_cast<std::uint64_t>(database.integer(
        "SELECT count(*) FROM part p CROSS JOIN configurations c ON c.number = p.configuration"
        " WHERE c.status = 'failed' AND c.may_pass"));
}

} // namespace gnomon::store
