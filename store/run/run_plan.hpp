#pragma once

#include "analysis/results/results.hpp"
#include "store/run/run_types.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::store {

/// Implements `RunStore::plan` in one transaction.
PlanOutcome write_plan(const sqlite::Database& database, const RunDescription& description,
                       const ShowConfigurations& show, Environments environments,
                       OtherScenes other_scenes);

/// Implements `RunStore::has_configurations`.
[[nodiscard]] bool has_configurations(const sqlite::Database& database);

/// Counts this part's configurations by state. `retired` and `has_equal_ids` stay at their
/// defaults.
[[nodiscard]] PlanOutcome read_outcome(const sqlite::Database& database);

/// Implements `RunStore::retriable`.
[[nodiscard]] std::uint64_t read_retriable(const sqlite::Database& database);

/// Writes the run's description; call it within a transaction.
void write_description(const sqlite::Database& database, const RunDescription& description);

/// The scenes of the finished configurations of a run's last plan, by content and by name. A file
/// that was edited keeps its name, and one that was moved keeps its content: both still match.
class PlannedScenes {
public:
    explicit PlannedScenes(const sqlite::Database& database);

    /// Whether the configuration uses one of these scenes.
    [[nodiscard]] bool contain(const analysis::Configuration& configuration) const;
    [[nodiscard]] bool empty() const { return names_.empty(); }
    /// The name of one scene, for messages: `yard`, model.glb.
    [[nodiscard]] std::string example() const { return names_.begin()->second; }

private:
    std::set<std::string> hashes_;
    std::set<std::pair<std::string, std::string>> names_; ///< key and value
};

} // namespace gnomon::store
