#include "store/merge/merge_into.hpp"

#include "scene/error.hpp"
#include "scene/one_line.hpp"
#include "store/merge/merge_sql.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

void require_same_sweep(const Database& database, const std::filesystem::path& run)
{
    Statement find{database, merge_sql::other_plan()};
    if (find.step()) {
        refuse_input(run,
                     fmt::format("is of another sweep than the runs before it: its configuration "
                                 "{} is another; merge the parts of one",
                                 find.integer(0)));
    }
}

void require_no_conflict(const Database& database, const std::filesystem::path& run)
{
    std::vector<merge_sql::Conflict> conflicts = merge_sql::conflicts();
    if (has_map_errors(database, "input")) {
        conflicts.push_back(merge_sql::map_conflict());
    }
    for (const merge_sql::Conflict& conflict : conflicts) {
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
        const bool shares_any = database.integer(merge_sql::shares_any()) != 0;
        if (shares_any) {
            require_same_sweep(database, run);
            require_no_conflict(database, run);
        }
        // Units of a plan share nothing, and there are thousands: what has no effect on them takes
        // most of their time.
        for (const std::string& statement :
             shares_any ? merge_sql::merge_statements() : merge_sql::addition_statements()) {
            database.run(statement);
        }
        if (has_map_errors(database, "input")) {
            database.run(merge_sql::new_map_errors());
        }
        if (more) {
            more();
        }
        transaction.commit();
    }
    database.run("DETACH input");
}

} // namespace gnomon::store
