#pragma once

#include <string>
#include <string_view>
#include <vector>

/// SQL that unites the run attached as `input` with the main one. Numbers of rows differ between
/// the two; ids, ordinals and environments' names are the same.
namespace gnomon::store::merge_sql {

/// Selects 1 if the two share a configuration, a curve or an ordinal, else 0. If they share none,
/// there can be no conflict, and no result is better than another.
[[nodiscard]] std::string shares_any();

/// Selects an ordinal that the two plans give to different configurations; no row if there is none.
[[nodiscard]] std::string other_plan();

/// A query for two results that differ: it selects the id of what they are of, and a column; no row
/// if there are none.
struct Conflict {
    std::string_view subject; ///< what the id names
    std::string query;
};
[[nodiscard]] std::vector<Conflict> conflicts();
/// The same of errors by map, where the input has them.
[[nodiscard]] Conflict map_conflict();

/// What makes the main run the union, once there are no conflicts; in this order. The texts stay as
/// they are from the first call on: thousands of files are united with them.
[[nodiscard]] const std::vector<std::string>& merge_statements();
/// The same where the two share nothing.
[[nodiscard]] const std::vector<std::string>& addition_statements();
/// Copies errors by map after all of these, where the input has them.
[[nodiscard]] std::string new_map_errors();

} // namespace gnomon::store::merge_sql
