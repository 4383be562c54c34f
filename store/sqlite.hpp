#pragma once

#include "scene/error.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

struct sqlite3;
struct sqlite3_stmt;

namespace gnomon::store::sqlite {

/// What a column of a row holds; `std::monostate` is NULL.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A value that lives as long as the statement is not stepped or reset.
using ValueView = std::variant<std::monostate, std::int64_t, double, std::string_view>;

/// A file that is no database, or not a whole one.
class DamagedDatabase : public scene::InputError {
    using InputError::InputError;
};

class Database;

/// A prepared statement. Every function throws as `Database` does.
class Statement {
public:
    Statement(const Database& database, const std::string& sql);

    /// Binds a parameter, numbered from 1; they keep their values until bound anew.
    Statement& bind(int parameter, std::int64_t value);
    Statement& bind(int parameter, double value);
    /// The text must stay until the statement was run.
    Statement& bind(int parameter, std::string_view value);
    /// Copies a text.
    Statement& bind(int parameter, const Value& value);

    /// Runs it to its end.
    void run();
    /// Moves to the next row; false after the last, and then it can be bound and stepped anew.
    bool step();
    /// Ends it before its last row.
    void reset();
    /// Runs it for the integer in its first row's first column; empty without a row.
    [[nodiscard]] std::optional<std::int64_t> first();

    [[nodiscard]] int parameter_count() const;
    [[nodiscard]] int column_count() const;
    /// Columns are numbered from 0. The integer of NULL is 0, its text empty.
    [[nodiscard]] std::string column_name(int column) const;
    [[nodiscard]] bool is_null(int column) const;
    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] std::string text(int column) const;
    [[nodiscard]] ValueView value(int column) const;

private:
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const noexcept;
    };
    void check_binding(int code) const;

    const Database* database_;
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// An SQLite database in a file; it outlives its statements.
///
/// Every function throws, naming the file,
///   scene::InputError        if the file is no database, or is damaged;
///   scene::EnvironmentError  if anything else fails.
class Database {
public:
    enum class Access : std::uint8_t { read, write };

    /// @param access  `write` makes the file where there is none.
    Database(const std::filesystem::path& path, Access access);
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;
    ~Database();

    /// Runs statements that return nothing of interest.
    void run(const std::string& sql) const;
    /// The integer in the first row's first column; 0 if there is none, or it is NULL.
    [[nodiscard]] std::int64_t integer(const std::string& sql) const;
    /// Rows that the last statement changed.
    [[nodiscard]] std::int64_t changes() const;
    /// The rowid of the row that was inserted last.
    [[nodiscard]] std::int64_t last_inserted() const;
    /// Whether that table or view is there.
    [[nodiscard]] bool has(std::string_view name) const;
    /// Adds another file, read only, whose tables are `name.TABLE`.
    void attach(const std::filesystem::path& path, std::string_view name) const;

    /// @throws scene::InputError  if the file is damaged; reads all of it.
    void require_sound() const;
    /// Lets others read while this connection writes, and puts every commit on the disk. At its end
    /// the database becomes one file again, which can be read where nothing may be written (unless
    /// somebody reads it just then).
    void enter_wal_mode();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] sqlite3* handle() const { return handle_.get(); }
    /// Throws what stands for the error code of an SQLite function.
    [[noreturn]] void fail(int code) const;

private:
    [[noreturn]] void fail_as_damaged(std::string_view what) const;

    struct Close {
        void operator()(sqlite3* handle) const noexcept;
    };
    std::filesystem::path path_;
    std::unique_ptr<sqlite3, Close> handle_;
    bool is_in_wal_mode_ = false;
};

/// All or nothing: what happens to the database until `commit`, or none of it.
class Transaction {
public:
    enum class Kind : std::uint8_t { read, write };

    explicit Transaction(const Database& database, Kind kind = Kind::write);
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    ~Transaction();

    /// On return it is on the disk.
    void commit();

private:
    const Database* database_;
};

/// A name in SQL: in double quotes.
[[nodiscard]] std::string sql_name(std::string_view name);

} // namespace gnomon::store::sqlite
