#pragma once

#include "scene/job/keys/key.hpp"
#include "scene/settings/job.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

/// A name that `method.name` takes.
struct MethodChoice {
    std::string name;
    bool has_filters = false; ///< else a job with this method has no lookup.filter
    std::vector<std::string> unread_tables = {}; ///< it has no key of these: "bias"
};

/// The keys that jobs have: the scene's own, those that methods add, and those of another renderer.
/// It never changes; jobs that were read with it hold it (`Keys`).
class KeyTable {
public:
    /// The scene's own keys, and one method, "depth".
    KeyTable();

    /// @param added  keys beside the scene's own (`added_key`): of `[method]`, `[bias]` and
    ///               `[engine]`.
    /// @throws std::logic_error  if there is no method, or if a key repeats, is of another table,
    ///                           or was not made by `added_key`.
    KeyTable(std::vector<MethodChoice> methods, std::vector<Key> added);

    // What is read with a table points into it.
    KeyTable(const KeyTable&) = delete;
    KeyTable& operator=(const KeyTable&) = delete;

    /// The same table with the keys that another renderer has of its own, "engine.KEY": jobs of
    /// every method have them.
    /// @throws std::logic_error  as the constructor.
    [[nodiscard]] std::shared_ptr<const KeyTable> with_engine_keys(std::vector<Key> engine) const;

    /// All rows, in the order of a job file; a built-in's parameters follow the other keys of
    /// [scene].
    [[nodiscard]] const std::vector<Key>& rows() const { return rows_; }

    /// The row of that name, or nullptr.
    [[nodiscard]] const Key* find(std::string_view name) const;

    /// Whether a key is `name` followed by a dot and more.
    [[nodiscard]] bool has_table(std::string_view name) const;

    /// The method of a job that names none: "depth", or without it the first.
    [[nodiscard]] const std::string& default_method() const;

    /// Whether jobs of the method of that name have a lookup.filter.
    [[nodiscard]] bool has_filters(std::string_view method) const;

    /// Whether jobs of the method of that name have a key, or keys of a table ("bias."): one of the
    /// scene's own, which methods share.
    [[nodiscard]] bool has_key(std::string_view method, std::string_view key) const;

private:
    [[nodiscard]] Key shared_row(Key key) const;

    std::vector<MethodChoice> methods_;
    std::vector<Key> rows_;
    std::vector<Key> added_; ///< as they were given
    std::map<std::string_view, const Key*> by_name_;
};

/// A table of keys, shared by all that was read with it.
using Keys = std::shared_ptr<const KeyTable>;

/// The table of the scene's own keys.
[[nodiscard]] const Keys& own_keys();

/// The table that the job was read with; of a job that was not read, the scene's own.
[[nodiscard]] const Keys& key_table_of(const Job& job);
/// The same table, to be read at once.
[[nodiscard]] const KeyTable& keys_of(const Job& job);

/// What a job of defaults has the key at, of the same method and layout as the job.
[[nodiscard]] std::optional<JobValue> default_of(const Key& key, const Job& job);

/// What the job has the key at: of an added key the default where the job does not say it.
[[nodiscard]] std::optional<JobValue> value_in(const Key& key, const Job& job);

/// The job with every key written out, as (key, TOML value), in the order of the rows; keys of a
/// camera or light that the job leaves to the scene are absent. The columns of a result table.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> resolved_keys(const Job& job);

/// Whether the job's method has filters, and whether it has a key (`KeyTable`).
[[nodiscard]] bool has_filters(const Job& job);
[[nodiscard]] bool has_key(const Job& job, std::string_view key);

/// The value that the job has of an added key; nullptr where its method has no such key.
[[nodiscard]] const JobValue* find_added_value(const Job& job, std::string_view name);

/// Whether a key, or a table, is of [engine].
[[nodiscard]] bool is_engine_key(std::string_view name);

/// Why keys of [engine] are not known, where no renderer is.
inline constexpr std::string_view engine_place =
    "keys of [engine] are a renderer's own: name it with renderer = \"NAME\" in the job file, "
    "--renderer NAME or --renderer-command";

} // namespace gnomon::scene
