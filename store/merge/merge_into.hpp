#pragma once

#include "store/sqlite.hpp"

#include <filesystem>
#include <functional>
#include <string_view>

namespace gnomon::store {

/// Refuses to unite a run, or a unit's file.
/// @throws scene::InputError  always: which one, and what is to be said of it.
[[noreturn]] void refuse_input(const std::filesystem::path& run, std::string_view what);

/// Adds the results of another database to those of a run, in one transaction: results win over
/// failures, and failures over nothing.
/// @param input  the other's file.
/// @param run    what messages call it.
/// @param more   what belongs into the same transaction; nothing: empty.
/// @throws scene::InputError  if it is of another sweep, or two results of one configuration
/// differ.
void merge_into(const sqlite::Database& database, const std::filesystem::path& input,
                const std::filesystem::path& run, const std::function<void()>& more = {});

} // namespace gnomon::store
