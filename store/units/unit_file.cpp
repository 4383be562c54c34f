#include "store/units/unit_file.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/output_file.hpp"
#include "store/run/run_plan.hpp"
#include "store/run/run_record.hpp"
#include "store/run/run_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

namespace gnomon::store {

namespace {

using sqlite::Database;
using sqlite::Statement;

namespace fs = std::filesystem;

std::string fact_of(const Database& database, std::string_view key)
{
    Statement find{database, "SELECT value FROM run WHERE key = ?"};
    return find.bind(1, key).step() ? find.text(0) : std::string{};
}

void write_fact(const Database& database, std::string_view key, std::string_view value)
{
    Statement{database, "INSERT OR REPLACE INTO run VALUES (?, ?)"}
        .bind(1, key)
        .bind(2, value)
        .run();
}

/// SQLite itself accepts an empty file, and one whose last page is truncated.
void require_whole(const Database& database, const fs::path& file)
{
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    const auto pages = static_cast<std::uintmax_t>(database.integer("PRAGMA page_count"));
    const auto page_bytes = static_cast<std::uintmax_t>(database.integer("PRAGMA page_size"));
    if (error || size == 0 || size != pages * page_bytes) {
        throw sqlite::DamagedDatabase(scene::one_line(
            fmt::format("{}: is incomplete: compute the unit again", file.string())));
    }
}

std::vector<std::string> scene_hashes(const Database& database)
{
    std::vector<std::string> hashes;
    Statement find{database, "SELECT DISTINCT scene_hash FROM curves ORDER BY scene_hash"};
    while (find.step()) {
        hashes.push_back(find.text(0));
    }
    return hashes;
}

} // namespace

fs::path unit_path(const fs::path& folder, const std::string& unit)
{
    return folder / (unit + unit_extension);
}

std::vector<fs::path> unit_files(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry{folder, error}; !error && entry != fs::directory_iterator{};
         entry.increment(error)) {
        if (entry->path().extension() == unit_extension) {
            files.push_back(entry->path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::optional<UnitMark> read_unit_mark(const Database& database)
{
    UnitMark mark{fact_of(database, "plan"), fact_of(database, "unit")};
    return mark.plan.empty() ? std::nullopt : std::optional{std::move(mark)};
}

void publish_unit(const fs::path& run, const UnitMark& mark, const fs::path& file)
{
    {
        const Database database{results_path(run), Database::Access::write};
        write_fact(database, "plan", mark.plan);
        write_fact(database, "unit", mark.unit);
        // A unit has few rows, so most pages of the default size would be empty.
        database.run("PRAGMA page_size = 1024");
        database.run("VACUUM");
    }
    std::ifstream bytes{results_path(run), std::ios::binary};
    const std::string text{std::istreambuf_iterator<char>{bytes}, {}};
    write_file(file, text);
}

UnitSummary read_unit_file(const fs::path& file)
{
    const Database database{file, Database::Access::read};
    require_whole(database, file);
    database.require_sound();
    require_run_schema(database);
    const auto mark = read_unit_mark(database);
    if (!mark) {
        throw scene::InputError(scene::one_line(
            fmt::format("{}: is not a file of `gnomon run-unit`: name another", file.string())));
    }
    return {*mark,
            read_description(database),
            scene_hashes(database),
            read_outcome(database),
            read_retriable(database),
            read_run_checks(database)};
}

} // namespace gnomon::store
