#include "store/run/run_environments.hpp"

#include "scene/error.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::store {

namespace {

using analysis::Environment;
using sqlite::Database;
using sqlite::Statement;

constexpr std::array<std::pair<std::string_view, std::string Environment::*>, 4>
    environment_columns{{{"gl_renderer", &Environment::gl_renderer},
                         {"gl_version", &Environment::gl_version},
                         {"embree", &Environment::embree},
                         {"gnomon", &Environment::gnomon}}};

Environment environment_of(Statement& row)
{
    Environment environment;
    int column = 0;
    for (const auto& [name, member] : environment_columns) {
        environment.*member = row.text(column++);
    }
    return environment;
}

} // namespace

std::int64_t record_environment(const Database& database, const Environment& environment)
{
    Statement insert{database, "INSERT OR IGNORE INTO environments"
                               " (gl_renderer, gl_version, embree, gnomon) VALUES (?, ?, ?, ?)"};
    Statement find{database, "SELECT number FROM environments WHERE gl_renderer = ?"
                             " AND gl_version = ? AND embree = ? AND gnomon = ?"};
    int parameter = 1;
    for (const auto& [name, member] : environment_columns) {
        insert.bind(parameter, std::string_view{environment.*member});
        find.bind(parameter++, std::string_view{environment.*member});
    }
    insert.run();
    return find.first().value_or(0); // it is there now
}

analysis::Environment find_environment(const Database& database, std::int64_t number)
{
    Statement find{database, "SELECT gl_renderer, gl_version, embree, gnomon FROM environments"
                             " WHERE number = ?"};
    return find.bind(1, number).step() ? environment_of(find) : Environment{};
}

void require_one_environment(const Database& database, const Environment& here)
{
    Statement others{database,
                     "SELECT gl_renderer, gl_version, embree, gnomon FROM environments e WHERE"
                     " number <> ? AND EXISTS"
                     " (SELECT 1 FROM configurations WHERE environment = e.number)"};
    if (!others.bind(1, record_environment(database, here)).step()) {
        return;
    }
    const Environment there = environment_of(others);
    for (const auto& [name, member] : environment_columns) {
        if (here.*member != there.*member) {
            throw scene::InputError(scene::one_line(fmt::format(
                "{}: its results come from another environment, {} was \"{}\" and is \"{}\": name "
                "another folder, or pass --allow-mixed",
                database.path().string(), name, there.*member, here.*member)));
        }
    }
}

} // namespace gnomon::store
