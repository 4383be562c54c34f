#include "store/run/planned_scenes.hpp"

#include "store/run/run_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

namespace gnomon::store {

namespace {

/// The keys that name a scene; a job has one of them.
constexpr auto scene_name_keys = std::to_array<std::string_view>({"scene.builtin", "scene.file"});

/// "c."scene.file"", or of the curve, as the tables have it.
std::string key_column(std::string_view key)
{
    return fmt::format("{}.{}", is_configuration_key(key) ? "c" : "v", sqlite::sql_name(key));
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

bool PlannedScenes::have(const analysis::Configuration& configuration) const
{
    return hashes_.contains(configuration.scene_hash) ||
           std::ranges::any_of(configuration.parameters, [&](const auto& parameter) {
               const sqlite::Value value = job_cell(parameter.second);
               const auto* const text = std::get_if<std::string>(&value);
               return text != nullptr && names_.contains({parameter.first, *text});
           });
}

} // namespace gnomon::store
