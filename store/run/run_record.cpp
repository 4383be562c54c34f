#include "store/run/run_record.hpp"

#include "store/json_values.hpp"
#include "store/run/run_environments.hpp"
#include "store/run/run_notes.hpp"

#include <algorithm>
#include <string_view>

namespace gnomon::store {

namespace {

using sqlite::Database;
using sqlite::Statement;

std::int64_t read_integer(const Database& database, std::string_view key)
{
    Statement find{database, "SELECT value FROM run WHERE key = ?"};
    return find.bind(1, key).first().value_or(0);
}

std::string read_text(const Database& database, std::string_view key)
{
    Statement find{database, "SELECT value FROM run WHERE key = ?"};
    return find.bind(1, key).step() ? find.text(0) : std::string{};
}

/// The texts of a JSON array; an empty list without one.
std::vector<std::string> read_texts(const Database& database, std::string_view key)
{
    const Json texts = Json::parse(read_text(database, key), nullptr, false);
    const auto is_text = [](const Json& text) { return text.is_string(); };
    return texts.is_array() && std::ranges::all_of(texts, is_text)
               ? texts.get<std::vector<std::string>>()
               : std::vector<std::string>{};
}

} // namespace

RunDescription read_description(const Database& database)
{
    RunDescription description;
    description.environment = find_environment(database, environment_number(database));
    description.shard = {static_cast<std::uint32_t>(read_integer(database, "shard_index")),
                         static_cast<std::uint32_t>(read_integer(database, "shard_count"))};
    description.size = static_cast<std::uint64_t>(read_integer(database, "size"));
    description.axes = read_axes(database);
    description.lights = read_texts(database, "lights");
    description.job = read_text(database, "job");
    description.command = read_text(database, "command");
    description.compare_command = read_text(database, "compare_command");
    description.notes = read_notes(read_text(database, "notes"));
    return description;
}

std::vector<std::string> read_axes(const Database& database)
{
    return read_texts(database, "axes");
}

std::vector<std::string> read_engine_keys(const Database& database)
{
    return read_texts(database, "engine_keys");
}

std::int64_t environment_number(const Database& database)
{
    return read_integer(database, "environment");
}

} // namespace gnomon::store
