#include "store/run/run_reader.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/run/run_plan.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>

namespace gnomon::store {

using sqlite::Database;
using sqlite::Statement;

namespace {

/// The path of the folder's database, after checking that it can be read.
std::filesystem::path checked_path(const std::filesystem::path& folder, RunStore::Access access)
{
    (void)RunStore{folder, access};
    return results_path(folder);
}

} // namespace

RunReader::RunReader(const std::filesystem::path& folder, RunStore::Access access)
    : folder_{folder},
      database_{checked_path(folder, access), Database::Access::read},
      schema_{prepare_reading(database_)},
      moment_{database_, sqlite::Transaction::Kind::read},
      description_{read_description(database_)},
      outcome_{read_outcome(database_)}
{
    if (description_.size == 0) {
        throw scene::InputError(
            fmt::format("{}: no configuration is planned in it: run `gnomon sweep`",
                        scene::one_line(folder.string())));
    }
}

std::vector<ResultRow> RunReader::rows(std::string_view clause) const
{
    std::vector<ResultRow> rows;
    Statement find{database_, fmt::format("SELECT * FROM results {}", clause)};
    while (find.step()) {
        rows.emplace_back(find);
    }
    return rows;
}

} // namespace gnomon::store
