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
    bool has_filters = false;                    ///< whether its jobs have lookup.filter
    std::vector<std::string> unread_tables = {}; ///< tables that it does not use: "bias"
};

/// All keys of jobs: the layer `scene`'s own, those of methods, and those of another renderer.
/// Immutable; jobs that were read with a table share it (`Keys`).
class KeyTable {
public:
    /// The scene's own keys, and one method, "depth".
    KeyTable();

    /// @param added  keys beside the scene's own (`added_key`): of `[method]`, `[bias]` and
    ///               `[engine]`.
    /// @throws std::logic_error  if there is no method, or a key repeats, belongs to another table,
    ///                           or was not made by `added_key`.
    KeyTable(std::vector<MethodChoice> methods, std::vector<Key> added);

    // Jobs that were read with a table point into it.
    KeyTable(const KeyTable&) = delete;
    KeyTable& operator=(const KeyTable&) = delete;

    /// This table with another renderer's own keys, "engine.KEY", which jobs of every method have.
    /// @throws std::logic_error  as the constructor.
    [[nodiscard]] std::shared_ptr<const KeyTable> with_engine_keys(std::vector<Key> engine) const;

    /// All keys, in the order of a job file; built-in parameters follow the other keys of [scene].
    [[nodiscard]] const std::vector<Key>& rows() const { return rows_; }

    /// The key of that name, or nullptr.
    [[nodiscard]] const Key* find(std::string_view name) const;

    /// Whether a key is `name` followed by a dot and more.
    [[nodiscard]] bool has_table(std::string_view name) const;

    /// The default method: "depth", or else the first.
    [[nodiscard]] const std::string& default_method() const;

    /// Whether jobs of the method of that name have a lookup.filter.
    [[nodiscard]] bool has_filters(std::string_view method) const;

    /// Whether jobs of that method have a key, or any key of a table ("bias."). Only for the layer
    /// `scene`'s own keys, which methods share.
    [[nodiscard]] bool has_key(std::string_view method, std::string_view key) const;

private:
    [[nodiscard]] Key shared_row(Key key) const;

    std::vector<MethodChoice> methods_;
    std::vector<Key> rows_;
    std::vector<Key> added_; ///< as they were given
    std::map<std::string_view, const Key*> by_name_;
};

/// A shared table of keys.
using Keys = std::shared_ptr<const KeyTable>;

/// The table with only the layer `scene`'s own keys.
[[nodiscard]] const Keys& own_keys();

/// The table that the job was read with, or `own_keys` if it was not read.
[[nodiscard]] const Keys& key_table_of(const Job& job);
/// The table that the job was read with, or that of `own_keys`.
[[nodiscard]] const KeyTable& keys_of(const Job& job);

/// The key's default, for the job's method and layout.
[[nodiscard]] std::optional<JobValue> default_of(const Key& key, const Job& job);

/// The key's value in the job; the default of an added key that the job does not set.
[[nodiscard]] std::optional<JobValue> value_in(const Key& key, const Job& job);

/// All keys of the job as (key, TOML value), in the order of the table: the columns of a result
/// table. Omits a camera or light that the scene decides.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> resolved_keys(const Job& job);

/// Whether the job's method has filters, and whether it has a key (`KeyTable`).
[[nodiscard]] bool has_filters(const Job& job);
[[nodiscard]] bool has_key(const Job& job, std::string_view key);

/// The job's value of an added key; nullptr if its method has no such key.
[[nodiscard]] const JobValue* find_added_value(const Job& job, std::string_view name);

/// Whether a key or table belongs to [engine].
[[nodiscard]] bool is_engine_key(std::string_view name);

/// The error text for keys of [engine] without a renderer.
inline constexpr std::string_view engine_place =
    "keys of [engine] are a renderer's own: name it with renderer = \"NAME\" in the job file, "
    "--renderer NAME or --renderer-command";

} // namespace gnomon::scene
