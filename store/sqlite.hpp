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

/// The value of a column; `std::monostate` is NULL.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A value that is valid until the statement is stepped or reset.
using ValueView = std::variant<std::monostate, std::int64_t, double, std::string_view>;

/// A file that is not a database, or is damaged.
class DamagedDatabase : public scene::InputError {
    using InputError::InputError;
};

class Database;

/// A prepared statement. Every function throws as `Database` does.
class Statement {
public:
    Statement(const Database& database, const std::string& sql);

    /// Binds a parameter, numbered from 1. It keeps its value until bound again.
    Statement& bind(int parameter, std::int64_t value);
    Statement& bind(int parameter, double value);
    /// The text must outlive the run of the statement.
    Statement& bind(int parameter, std::string_view value);
    /// Copies the text.
    Statement& bind(int parameter, const Value& value);

    /// Runs the statement to its end.
    void run();
    /// Moves to the next row. Returns false after the last, and resets the statement.
    bool step();
    /// Ends the statement before its last row.
    void reset();
    /// Runs the statement and returns the first column of its first row; empty without a row.
    [[nodiscard]] std::optional<std::int64_t> first();

    [[nodiscard]] int parameter_count() const;
    [[nodiscard]] int column_count() const;
    /// Columns are numbered from 0. NULL reads as the integer 0 or an empty text.
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

/// An SQLite database in a file. It must outlive its statements.
///
/// Every function throws, naming the file,
///   scene::InputError        if the file is damaged or not a database;
///   scene::EnvironmentError  for any other failure.
class Database {
public:
    enum class Access : std::uint8_t { read, write };

    /// @param access  `write` creates a missing file.
    Database(const std::filesystem::path& path, Access access);
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;
    ~Database();

    /// Runs statements and ignores their rows.
    void run(const std::string& sql) const;
    /// The integer in the first column of the first row; 0 without a row, or for NULL.
    [[nodiscard]] std::int64_t integer(const std::string& sql) const;
    /// The number of rows that the last statement changed.
    [[nodiscard]] std::int64_t changes() const;
    /// The rowid of the last inserted row.
    [[nodiscard]] std::int64_t last_inserted() const;
    /// Whether the database has this table or view.
    [[nodiscard]] bool has(std::string_view name) const;
    /// Attaches another file for reading; its tables are `name.TABLE`.
    void attach(const std::filesystem::path& path, std::string_view name) const;

    /// Reads the whole file.
    /// @throws scene::InputError  if the file is damaged.
    void require_sound() const;
    /// Lets others read while this connection writes, and flushes every commit to the disk. The
    /// destructor leaves WAL mode, so the database can be read on a read-only disk, unless it is
    /// being read then.
    void enter_wal_mode();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] sqlite3* handle() const { return handle_.get(); }
    /// Throws the exception for an SQLite error code.
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

/// A transaction; the destructor rolls back what was not committed.
class Transaction {
public:
    enum class Kind : std::uint8_t { read, write };

    explicit Transaction(const Database& database, Kind kind = Kind::write);
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    ~Transaction();

    /// The data is on the disk when this returns.
    void commit();

private:
    const Database* database_;
};

/// A name in SQL, in double quotes.
[[nodiscard]] std::string sql_name(std::string_view name);

} // namespace gnomon::store::sqlite
