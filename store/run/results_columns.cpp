#include "store/run/results_columns.hpp"

#include "store/run/run_columns.hpp"
#include "store/run/run_record.hpp"
#include "store/run/schema_version.hpp"
#include "store/sqlite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace gnomon::store {

using sqlite::sql_name;

std::vector<std::string> light_columns(const std::vector<std::string>& axes)
{
    std::vector<std::string> columns;
    for (const std::string& axis : axes) {
        if (std::ranges::find(job_columns(), axis, &JobColumn::name) == job_columns().end()) {
            columns.push_back(axis);
        }
    }
    std::ranges::sort(columns);
    return columns;
}

std::vector<std::string> light_columns(const sqlite::Database& database)
{
    std::vector<std::string> keys = read_axes(database);
    for (std::string& key : read_engine_keys(database)) {
        if (std::ranges::find(keys, key) == keys.end()) {
            keys.push_back(std::move(key));
        }
    }
    return light_columns(keys);
}

std::vector<ResultsColumn> results_columns(const std::vector<std::string>& light_columns)
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
    for (const std::string& column : light_columns) {
        const auto after_case = std::ranges::find(all, "status", &ResultsColumn::name);
        all.insert(after_case,
                   {column, fmt::format("json_extract(p.light_values, '$.\"{}\"')", column),
                    Of::configuration});
    }
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

} // namespace gnomon::store
