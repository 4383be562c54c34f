#include "store/sqlite.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cassert>
#include <system_error>

namespace gnomon::store::sqlite {

namespace {

constexpr int busy_timeout_ms = 10'000;

bool is_damage(int code)
{
    const int primary = code & 0xFF;
    return primary == SQLITE_CORRUPT || primary == SQLITE_NOTADB;
}

/// Whether `sqlite3_system_errno` belongs to this error, and not to an earlier one.
bool comes_from_the_system(int code)
{
    const int primary = code & 0xFF;
    return primary == SQLITE_IOERR || primary == SQLITE_CANTOPEN;
}

std::string sqlite_remedy(int code)
{
    switch (code & 0xFF) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
        return "recorded results are kept: make room or repair the disk, and run the same "
               "command again: it resumes";
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_AUTH:
        return "recorded results are kept: make the folder writable and run the same command "
               "again: it resumes";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return "another program keeps it locked: end that program, and run the same command again";
    default:
        return "run the same command again: it resumes";
    }
}

/// Stops SQLite from counting its allocations, which would make threads wait for each other. Only
/// works before the first database is opened.
void stop_counting_memory()
{
    [[maybe_unused]] static const int code = sqlite3_config(SQLITE_CONFIG_MEMSTATUS, 0);
}

/// The path as an SQLite URI, which reserves some characters.
std::string uri(const std::filesystem::path& path)
{
    std::string text = "file:";
    for (const char c : path.string()) {
        if (c == '%' || c == '?' || c == '#') {
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        } else {
            text += c;
        }
    }
    return text;
}

} // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const noexcept
{
    sqlite3_finalize(statement);
}

Statement::Statement(const Database& database, const std::string& sql) : database_{&database}
{
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v2(database.handle(), sql.c_str(),
                                        static_cast<int>(sql.size() + 1), &statement, nullptr);
    if (code != SQLITE_OK) {
        database.fail(code);
    }
    statement_.reset(statement);
}

void Statement::check_binding(int code) const
{
    if (code != SQLITE_OK) {
        database_->fail(code);
    }
}

Statement& Statement::bind(int parameter, std::int64_t value)
{
    check_binding(sqlite3_bind_int64(statement_.get(), parameter, value));
    return *this;
}

Statement& Statement::bind(int parameter, double value)
{
    check_binding(sqlite3_bind_double(statement_.get(), parameter, value));
    return *this;
}

Statement& Statement::bind(int parameter, std::string_view value)
{
    // An empty view may point nowhere, which SQLite would take for NULL.
    const char* const data = value.empty() ? "" : value.data();
    check_binding(sqlite3_bind_text64(statement_.get(), parameter, data, value.size(),
                                      SQLITE_STATIC, SQLITE_UTF8));
    return *this;
}

Statement& Statement::bind(int parameter, const Value& value)
{
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return bind(parameter, *integer);
    }
    if (const auto* real = std::get_if<double>(&value)) {
        return bind(parameter, *real);
    }
    if (const auto* text = std::get_if<std::string>(&value)) {
        check_binding(sqlite3_bind_text64(statement_.get(), parameter, text->data(), text->size(),
                                          SQLITE_TRANSIENT, SQLITE_UTF8));
        return *this;
    }
    check_binding(sqlite3_bind_null(statement_.get(), parameter));
    return *this;
}

void Statement::run()
{
    while (step()) {
    }
}

bool Statement::step()
{
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) {
        return true;
    }
    const int reset_code = sqlite3_reset(statement_.get());
    if (code != SQLITE_DONE) {
        database_->fail(reset_code != SQLITE_OK ? reset_code : code);
    }
    return false;
}

void Statement::reset()
{
    sqlite3_reset(statement_.get());
}

std::optional<std::int64_t> Statement::first()
{
    if (!step()) {
        return std::nullopt;
    }
    const std::int64_t result = integer(0);
    reset();
    return result;
}

int Statement::parameter_count() const
{
    return sqlite3_bind_parameter_count(statement_.get());
}

int Statement::column_count() const
{
    return sqlite3_column_count(statement_.get());
}

std::string Statement::column_name(int column) const
{
    const char* const name = sqlite3_column_name(statement_.get(), column);
    return name == nullptr ? "" : name;
}

bool Statement::is_null(int column) const
{
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::int64_t Statement::integer(int column) const
{
    return sqlite3_column_int64(statement_.get(), column);
}

std::string Statement::text(int column) const
{
    const auto* const bytes = sqlite3_column_text(statement_.get(), column);
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return bytes == nullptr
               ? std::string{}
               : std::string(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

ValueView Statement::value(int column) const
{
    switch (sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_INTEGER:
        return std::int64_t{sqlite3_column_int64(statement_.get(), column)};
    case SQLITE_FLOAT:
        return sqlite3_column_double(statement_.get(), column);
    case SQLITE_NULL:
        return std::monostate{};
    default:
        break;
    }
    const auto* const bytes = sqlite3_column_text(statement_.get(), column);
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
    return std::string_view{reinterpret_cast<const char*>(bytes), size};
}

void Database::Close::operator()(sqlite3* handle) const noexcept
{
    sqlite3_close_v2(handle);
}

Database::Database(const std::filesystem::path& path, Access access)
    : path_{std::filesystem::absolute(path)}
{
    stop_counting_memory();
    const int flags =
        access == Access::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    sqlite3* handle = nullptr;
    const int code = sqlite3_open_v2(path_.c_str(), &handle,
                                     flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_URI, nullptr);
    handle_.reset(handle);
    if (code != SQLITE_OK) {
        fail(code);
    }
    sqlite3_extended_result_codes(handle, 1);
    sqlite3_busy_timeout(handle, busy_timeout_ms);
}

Database::~Database()
{
    if (is_in_wal_mode_) {
        sqlite3_busy_timeout(handle(), 0);
        sqlite3_exec(handle(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
    }
}

void Database::run(const std::string& sql) const
{
    const int code = sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) {
        fail(code);
    }
}

std::int64_t Database::integer(const std::string& sql) const
{
    return Statement{*this, sql}.first().value_or(0);
}

std::int64_t Database::changes() const
{
    return sqlite3_changes64(handle());
}

std::int64_t Database::last_inserted() const
{
    return sqlite3_last_insert_rowid(handle());
}

bool Database::has(std::string_view name) const
{
    Statement search{*this, "SELECT 1 FROM sqlite_schema WHERE name = ?"};
    return search.bind(1, name).first().has_value();
}

void Database::attach(const std::filesystem::path& path, std::string_view name) const
{
    const std::string address = uri(std::filesystem::absolute(path)) + "?mode=ro";
    Statement statement{*this, "ATTACH ? AS ?"};
    statement.bind(1, std::string_view{address}).bind(2, name).run();
}

void Database::enter_wal_mode()
{
    run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
    is_in_wal_mode_ = true;
}

void Database::require_sound() const
{
    Statement check{*this, "PRAGMA quick_check(1)"};
    if (check.step() && check.text(0) != "ok") {
        fail_as_damaged(check.text(0));
    }
}

void Database::fail_as_damaged(std::string_view what) const
{
    throw DamagedDatabase(
        scene::one_line(fmt::format("{}: is damaged, or not a database of results ({}): restore a "
                                    "copy, or name another folder",
                                    path_.string(), what)));
}

void Database::fail(int code) const
{
    const char* const what = handle() != nullptr ? sqlite3_errmsg(handle()) : sqlite3_errstr(code);
    if (is_damage(code)) {
        fail_as_damaged(what);
    }
    const int number = comes_from_the_system(code) ? sqlite3_system_errno(handle()) : 0;
    const std::string cause =
        number == 0
            ? std::string{}
            : fmt::format(", {}", std::error_code{number, std::generic_category()}.message());
    throw scene::EnvironmentError(
        scene::one_line(fmt::format("cannot use {}: {}{} (SQLite {}); {}", path_.string(), what,
                                    cause, code, sqlite_remedy(code))));
}

Transaction::Transaction(const Database& database, Kind kind) : database_{&database}
{
    database.run(kind == Kind::read ? "BEGIN" : "BEGIN IMMEDIATE");
}

Transaction::~Transaction()
{
    // An error may have ended it already.
    if (database_ != nullptr && sqlite3_get_autocommit(database_->handle()) == 0) {
        sqlite3_exec(database_->handle(), "ROLLBACK", nullptr, nullptr, nullptr);
    }
}

void Transaction::commit()
{
    database_->run("COMMIT");
    database_ = nullptr;
}

std::string sql_name(std::string_view name)
{
    std::string text = "\"";
    for (const char c : name) {
        text += c;
        if (c == '"') {
            text += c;
        }
    }
    return text + '"';
}

} // namespace gnomon::store::sqlite
